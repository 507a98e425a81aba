// What is said where there is nothing to see: loading, a problem, no hulls, no three-dimensional drawing.
import { useEffect, useState } from "react";
import { useDecompose } from "../../store/decompose";
import { useProject } from "../../store/project";
import { useScenes } from "../../store/scenes";
import { useWorkspace } from "../../store/workspace";
import { MakeHulls } from "./MakeHulls";
import css from "./overlay.module.css";

const LOADING_DELAY = 150;

export function Messages() {
  const loading = useScenes((state) => state.loading);
  const problem = useScenes((state) => state.problem);
  const empty = useScenes(({ scene }) => (scene && scene.hulls.length === 0 ? scene.asset : null));
  const asset = useWorkspace((workspace) => workspace.asset);
  const makes = useDecompose(({ open, tried }) => asset !== null && (open === asset || tried?.asset === asset));
  const bare = useProject(({ cards }) => cards[empty ?? ""]?.hulls === 0 && (cards[empty ?? ""]?.sources ?? 0) > 0);
  return (
    <>
      {loading && <Loading />}
      {problem && (
        <div className={css.message} role="alert">
          <h3>This asset cannot be shown</h3>
          <p>{problem.where ? `${problem.where}: ${problem.message}` : problem.message}</p>
          {problem.remedy && <p className={css.remedy}>{problem.remedy}</p>}
        </div>
      )}
      {!problem && asset !== null && (makes || bare) ? <MakeHulls asset={asset} /> : !problem && empty !== null && <NoHulls />}
    </>
  );
}

/** Shows up only if it takes so long that one wonders. */
function Loading() {
  const [late, setLate] = useState(false);
  useEffect(() => {
    const timer = setTimeout(() => setLate(true), LOADING_DELAY);
    return () => clearTimeout(timer);
  }, []);
  return late ? (
    <div className={css.loading} role="progressbar" aria-label="Loading the asset">
      <div />
    </div>
  ) : null;
}

function NoHulls() {
  const edited = useScenes(({ scene }) => scene?.edit != null);
  return (
    <div className={css.message}>
      <h3>No hulls</h3>
      <p>{edited ? "The edits have removed all hulls of this asset." : "This file has no collision geometry and no geometry to make hulls from."}</p>
    </div>
  );
}

export function NoWebGl() {
  return (
    <div className={css.message} role="alert">
      <h3>This browser cannot show 3D graphics</h3>
      <p>The view needs WebGL 2, which is switched off or missing. The list of hulls still works.</p>
      <p className={css.remedy}>
        Switch on hardware acceleration in the browser&rsquo;s settings and reload the page, or open this address in a
        recent Chrome, Edge, Firefox or Safari.
      </p>
    </div>
  );
}
