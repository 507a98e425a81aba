// The view settings that the picture needs, and its parts: one, or before and after, side by side or with a line
// between them.
import type { Compare, ViewSettings } from "../../store/workspace";

export interface Pane {
  readonly which: "before" | "shown";
  /** Where its picture begins, how wide that is, and which part of the whole width can be seen of it [px]. */
  readonly x: number;
  readonly width: number;
  readonly clip: readonly [from: number, to: number];
}

/** both: whether there is something to compare with. */
export function panesOf(compare: Compare, both: boolean, divider: number, width: number): Pane[] {
  if (!both || compare === "off") return [{ which: "shown", x: 0, width, clip: [0, width] }];
  if (compare === "slider") {
    const line = Math.round(divider * width);
    return [
      { which: "before", x: 0, width, clip: [0, line] },
      { which: "shown", x: 0, width, clip: [line, width] },
    ];
  }
  const half = Math.floor(width / 2);
  return [
    { which: "before", x: 0, width: half, clip: [0, half] },
    { which: "shown", x: width - half, width: half, clip: [half, width] },
  ];
}

export function paneAt(panes: readonly Pane[], x: number): Pane {
  const pane = panes.find(({ clip }) => x >= clip[0] && x < clip[1]) ?? panes.at(-1);
  if (!pane) throw new RangeError("a picture has at least one pane");
  return pane;
}

/** explode: how far hulls move away, in their distances from the centre. */
export type Settings = Omit<ViewSettings, "colorBy" | "oneSize">;

const FARTHEST = 1.4;

/** What of the workspace's view settings the picture needs. */
export const settingsOf = (view: ViewSettings): Settings => ({ ...view, explode: FARTHEST * view.explode });
