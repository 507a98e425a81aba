// What is said where there is nothing to see: loading, a problem, no hulls, no three-dimensional drawing.
import { useEffect, useState } from "react";
import { makeHulls } from "../../store/jobs";
import { useProject } from "../../store/project";
import { useScenes } from "../../store/scenes";
import { Button } from "../../ui/Button";
import css from "./overlay.module.css";

const LOADING_DELAY = 150;

export function Messages() {
  const loading = useScenes((state) => state.loading);
  const problem = useScenes((state) => state.problem);
  const empty = useScenes(({ scene }) => (scene && scene.hulls.length === 0 ? scene.asset : null));
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
      {!problem && empty !== null && <NoHulls asset={empty} />}
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

function NoHulls({ asset }: { asset: string }) {
  const sources = useProject(({ cards }) => cards[asset]?.sources ?? 0);
  const edited = useScenes(({ scene }) => scene?.edit != null);
  const make = () => makeHulls([asset]);
  return (
    <div className={css.message}>
      <h3>No hulls</h3>
      {edited ? (
        <p>The edits have removed all hulls of this asset.</p>
      ) : sources > 0 ? (
        <>
          <p>This asset has no convex collision geometry yet. Decompose {pieces(sources)} that it has.</p>
          <Button look="primary" onClick={make}>
            Decompose into hulls
          </Button>
        </>
      ) : (
        <p>This file has no collision geometry and no geometry to make hulls from.</p>
      )}
    </div>
  );
}

const pieces = (count: number): string => (count === 1 ? "the one piece" : `the ${count} pieces`);

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
