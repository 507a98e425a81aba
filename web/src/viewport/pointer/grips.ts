// What each tool does with the left button.
import { paint } from "../../commands/labelling";
import { hover, select, selectMore, useDesk } from "../../store/desk";
import { hullAt, pieceAt } from "../stage/picking";
import type { Stage } from "../stage/stage";
import { beginCut } from "./cutting";
import type { Drag, Grip } from "./gestures";
import { beginRegion } from "./regions";

export function gripOf(stage: Stage): Grip {
  return {
    begin: (spot, event) => {
      const { tool, brush } = useDesk.getState();
      if (tool === "box" || tool === "lasso") return beginRegion(stage, tool, spot, event);
      if (tool === "cut") return beginCut(stage, spot);
      return tool === "select" && brush !== null ? beginStroke(stage, ...spot) : null;
    },
    click: ([x, y], event) => clicked(hullAt(stage, x, y), event),
    hover: (spot) => hover(spot && pieceAt(stage, ...spot)),
    drawsRegion: () => ["box", "lasso"].includes(useDesk.getState().tool),
  };
}

/** A click on a hull, or on nothing. */
function clicked(name: string | null, { shiftKey, ctrlKey, metaKey }: MouseEvent): void {
  const { tool, brush } = useDesk.getState();
  if (tool === "landmark") return name === null ? undefined : landmark(name);
  if (tool === "cut") return name === null ? undefined : select([name]);
  if (tool === "select" && brush !== null) return name === null ? undefined : paint([name]);
  if (name !== null) selectMore([name], shiftKey ? "add" : ctrlKey || metaKey ? "toggle" : "replace");
  else if (!shiftKey && !ctrlKey && !metaKey) select([]);
}

/** The first click is where the direction starts, the second where it ends; a third begins anew. */
function landmark(name: string): void {
  const { landmarks } = useDesk.getState();
  useDesk.setState({ landmarks: landmarks.length === 1 ? [...landmarks, name] : [name] });
}

/** A stroke of the brush over hulls; on nothing, the camera moves instead. */
function beginStroke(stage: Stage, x: number, y: number): Drag | null {
  const first = hullAt(stage, x, y);
  if (first === null) return null;
  const done = new Set([first]);
  const over = (name: string | null): void => {
    if (name === null || done.has(name)) return;
    done.add(name);
    paint([name]);
  };
  let began = false;
  return {
    move: ([nextX, nextY]) => {
      if (!began) paint([first]);
      began = true;
      const name = hullAt(stage, nextX, nextY);
      hover(name);
      over(name);
    },
    end: () => undefined,
    cancel: () => undefined,
  };
}
