// The controls of the cutting tool: along which axis, where, cut or leave.
import { useEffect } from "react";
import { type CutAxis, hullToCut, leaveCut, performCut, setCut, useCut } from "../../store/cut";
import { useScenes } from "../../store/scenes";
import { ACROSS } from "../../store/vectors";
import { useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Choice, Slide } from "../../ui/fields";
import css from "./overlay.module.css";

const AXES: readonly { value: CutAxis; label: string; name: string }[] = [
  ...ACROSS,
  { value: "free", label: "Free", name: "Along a line that you draw" },
];

export function CutBar() {
  const selection = useWorkspace((workspace) => workspace.selection);
  const scene = useScenes((state) => state.scene);
  const { axis, share, drawn } = useCut();
  const hull = hullToCut(scene, selection);
  useEffect(() => {
    // before other commands that have these keys
    window.addEventListener("keydown", press, true);
    return () => window.removeEventListener("keydown", press, true);
  }, []);
  return (
    <div className={css.bar} role="group" aria-label="Cut a hull">
      {hull ? (
        <>
          <span>
            Cut <b>{hull.name}</b>
          </span>
          <Choice name="Direction of the cut" value={axis} options={AXES} onChange={(next) => setCut({ axis: next })} />
          {axis === "free" && !drawn ? (
            <span>Draw a line across the hull.</span>
          ) : (
            <Slide name="Place of the cut" value={share} onChange={(next) => setCut({ share: next })} />
          )}
          <Button
            look="primary"
            disabled={axis === "free" && !drawn}
            onClick={() => void performCut()}
            tip="Split the hull in two along the plane"
            keys="Enter"
          >
            Cut
          </Button>
        </>
      ) : (
        <span>Click the hull to cut. Hulls made by a step cannot be cut.</span>
      )}
      <Button look="quiet" onClick={leaveCut} tip="Leave the tool" keys="Escape">
        Leave
      </Button>
    </div>
  );
}

function press(event: KeyboardEvent): void {
  if (event.key === "Escape") leaveCut();
  else if (event.key === "Enter" && !isOnButton(event)) void performCut();
  else return;
  event.preventDefault();
}

/** Whether Enter is for what has the focus; the choice of a direction, which Space takes, has no use for it. */
const isOnButton = ({ target }: KeyboardEvent): boolean =>
  target instanceof Element &&
  target.matches("button:not([role=radio]):focus-visible, input, textarea, [contenteditable=true]");
