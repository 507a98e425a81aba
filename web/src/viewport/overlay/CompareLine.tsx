// The line between before and after, dragged by pointer or arrow keys, and the names of both sides.
import { useScenes } from "../../store/scenes";
import { setView, useWorkspace } from "../../store/workspace";
import { Divider } from "../../ui/Divider";
import { useStage } from "../stage/context";
import css from "./overlay.module.css";

const RANGE = [0.02, 0.98] as const;

export function CompareLine() {
  const compare = useWorkspace((workspace) => workspace.view.compare);
  const both = useScenes(({ scene }) => scene?.edit != null);
  if (compare === "off" || !both) return null;
  return (
    <>
      {compare === "slider" ? <DividingLine /> : <div className={css.middle} />}
      <span className={css.sideName} style={{ left: 10 }} data-side>
        Before
      </span>
      <span className={css.sideName} style={{ left: compare === "side" ? "calc(50% + 10px)" : undefined, right: compare === "side" ? undefined : 110 }}>
        After
      </span>
    </>
  );
}

function DividingLine() {
  const stage = useStage();
  const divider = useWorkspace((workspace) => workspace.view.divider);
  return (
    <Divider
      name="Line between before and after"
      along="x"
      className={css.divider}
      style={{ left: `${100 * divider}%` }}
      value={divider}
      range={RANGE}
      unit={() => 1 / (stage.width || 1)}
      onChange={(value) => setView({ divider: value })}
    />
  );
}
