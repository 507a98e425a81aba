// What to click for the orientation, and marks on the hulls that were clicked.
import { useRef } from "react";
import { Button } from "../../ui/Button";
import { setTool, useDesk } from "../../store/desk";
import { useDrawn, useStage } from "../stage/context";
import css from "./overlay.module.css";

const NAMES = ["Start", "End"];

export function Landmarks() {
  const landmarks = useDesk((desk) => desk.landmarks);
  const tool = useDesk((desk) => desk.tool);
  return (
    <>
      {landmarks.map((name, k) => (
        <Mark key={name} hull={name} text={NAMES[k] ?? ""} />
      ))}
      {tool === "landmark" && (
        <div className={css.bar} role="status">
          {landmarks.length === 1
            ? "Now click the hull where the direction ends."
            : "Click the hull where the direction starts."}
          <Button look="quiet" onClick={() => setTool("select")} keys="Escape" tip="Leave">
            Leave
          </Button>
        </div>
      )}
    </>
  );
}

function Mark({ hull, text }: { hull: string; text: string }) {
  const stage = useStage();
  const mark = useRef<HTMLSpanElement>(null);
  useDrawn(() => {
    const place = stage.shown?.hulls.places.get(hull);
    const pane = stage.panes().at(-1);
    if (!mark.current || !stage.shown || place === undefined || !pane) return;
    const { x, y } = stage.pixelOf(stage.shown.hulls.middle(place, stage.settings.explode), pane);
    mark.current.style.transform = `translate(${x}px, ${y}px) translate(-50%, -140%)`;
  });
  return (
    <span ref={mark} className={css.mark}>
      {text}
    </span>
  );
}
