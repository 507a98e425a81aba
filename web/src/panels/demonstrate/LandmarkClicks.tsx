// A direction from two clicked hulls: it points from the landmark of the first to that of the second.
import { Crosshair } from "lucide-react";
import { useEffect, useState } from "react";
import { startLandmarks } from "../../commands/demonstrating";
import { setTool, useDesk } from "../../store/desk";
import { perform } from "../../store/edits";
import { clickedPair, type Directive, directiveText, withPair } from "../../store/orientation";
import { useScenes } from "../../store/scenes";
import { complained } from "../../store/toasts";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import css from "./demonstrate.module.css";
import { DirectionField } from "./DirectionField";

export function LandmarkClicks({ directive }: { directive: Directive }) {
  const clicking = useDesk((desk) => desk.tool === "landmark");
  const [direction, setDirection] = useState("+Z");
  if (!clicking) {
    return (
      <Button
        icon={Crosshair}
        onClick={startLandmarks}
        tip="Click a hull at the start and one at the end of a direction"
      >
        {directive.pairs.length ? "Another direction by clicking" : "Tell it by clicking"}
      </Button>
    );
  }
  return <Clicking directive={directive} direction={direction} setDirection={setDirection} />;
}

interface ClickingProps {
  directive: Directive;
  direction: string;
  setDirection: (direction: string) => void;
}

function Clicking({ directive, direction, setDirection }: ClickingProps) {
  const first = useDesk((desk) => desk.landmarks[0]);
  useEffect(
    () =>
      useDesk.subscribe(({ landmarks: [start, end] }) => {
        if (start === undefined || end === undefined) return;
        take(directive, direction, start, end);
      }),
    [directive, direction],
  );
  return (
    <div className={css.clicking}>
      <DirectionField value={direction} onChange={setDirection} />
      <Note>
        {first === undefined ? (
          <>
            <strong>1.</strong> Click a hull where {direction.replace("-", "−")} starts, as a leg for up.
          </>
        ) : (
          <>
            Starts at <strong>{labelOf(first) ?? first}</strong>. <strong>2.</strong> Click a hull that it points to.
          </>
        )}
      </Note>
      <Button onClick={() => setTool("select")}>Cancel</Button>
    </div>
  );
}

/** Makes the directive of two clicked hulls; where they cannot be landmarks, clicking begins anew. */
function take(directive: Directive, direction: string, start: string, end: string): void {
  const pair = clickedPair(direction, labelOf(start), labelOf(end));
  if (typeof pair === "string") {
    setTool("landmark");
    return complained({ message: pair, where: null, remedy: null, conflict: false });
  }
  setTool("select");
  void perform({ kind: "orient", text: directiveText(withPair(directive, pair)) });
}

function labelOf(name: string): string | null {
  return useScenes.getState().scene?.hulls.find((hull) => hull.name === name)?.label ?? null;
}
