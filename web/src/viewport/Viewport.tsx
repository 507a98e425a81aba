// The view of an asset: a toolbar, the picture, and what lies over it.
import { useEffect, useRef, useState } from "react";
import { Outcome } from "../outcome/Outcome";
import { useDesk } from "../store/desk";
import { useScenes } from "../store/scenes";
import { CutBar } from "./overlay/CutBar";
import { Divider } from "./overlay/Divider";
import { Drawn } from "./overlay/Drawn";
import { Gaps } from "./overlay/Gaps";
import { Hud } from "./overlay/Hud";
import { Landmarks } from "./overlay/Landmarks";
import { Legend } from "./overlay/Legend";
import { NoWebGl, State } from "./overlay/State";
import { ViewCube } from "./overlay/ViewCube";
import { type Paper, paper } from "./paper";
import { Picture } from "./Picture";
import { StageContext } from "./stage/context";
import { expose } from "./stage/exposed";
import { settingsOf } from "./stage/settings";
import { Stage } from "./stage/stage";
import { Toolbar } from "./toolbar/Toolbar";
import css from "./viewport.module.css";

export function Viewport() {
  const [sheet] = useState(paper);
  const [stage] = useState(() => new Stage(settingsOf(useDesk.getState().view), sheet?.smooth ?? true));
  const root = useRef<HTMLElement>(null);
  const asset = useScenes(({ scene }) => scene?.asset ?? "");
  const loading = useScenes((state) => state.loading);
  useEffect(() => (root.current ? expose(stage, root.current) : undefined), [stage]);
  return (
    <StageContext.Provider value={stage}>
      <section
        ref={root}
        className={css.viewport}
        data-testid="viewport"
        data-asset={asset}
        aria-label="View"
        aria-busy={loading}
      >
        <Toolbar />
        <div className={css.stage}>
          {sheet ? <Shown sheet={sheet} /> : <NoWebGl />}
          <State />
        </div>
      </section>
    </StageContext.Provider>
  );
}

function Shown({ sheet }: { sheet: Paper }) {
  return (
    <>
      <Picture gl={sheet.gl} />
      <Drawn />
      <Divider />
      <Gaps />
      <Landmarks />
      <ViewCube />
      <Hud />
      <Legend />
      <CutBar />
      <div className={css.outcome}>
        <Outcome />
      </div>
    </>
  );
}
