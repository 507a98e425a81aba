// Painting: a stroke over hulls labels each one it meets.
import type { Spot } from "../geometry/region";
import { hullAt } from "../stage/picking";
import type { Stage } from "../stage/stage";
import { endStroke, paint } from "../../store/labels";
import { hover } from "../../store/workspace";
import type { Drag } from "./gestures";
import { noteDrag } from "./heldKeys";

/** Between two spots of the pointer, how far apart those are that are looked at [px]. */
const STEP = 4;

/** A stroke of the brush over hulls; on nothing, the camera moves instead. */
export function beginStroke(stage: Stage, start: Spot): Drag | null {
  const first = hullAt(stage, ...start);
  if (first === null) return null;
  const done = new Set<string>();
  const over = (name: string | null): void => {
    if (name === null || done.has(name)) return;
    done.add(name);
    paint([name]);
  };
  const end = (): void => {
    noteDrag();
    endStroke();
  };
  let last = start;
  return {
    move: (spot) => {
      over(first);
      for (const [x, y] of spotsBetween(last, spot)) over(hullAt(stage, x, y));
      last = spot;
      hover(hullAt(stage, ...spot));
    },
    end,
    cancel: end,
  };
}

/** Spots from one, without it, to another, which a quick pointer passes over. */
export function spotsBetween(from: Spot, to: Spot): Spot[] {
  const count = Math.max(1, Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / STEP));
  return Array.from({ length: count }, (_, k): Spot => {
    const share = (k + 1) / count;
    return [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
  });
}
