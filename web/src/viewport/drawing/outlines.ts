// The outlines of hulls: each is a line on a casing, one of them dark and one light, so that it is seen on any colour.
// Which outline it is can be told without colours: by which of both is dark, by width, and by dashes.
import type { Color } from "three";
import { Strokes, type StrokeStyle } from "./strokes";
import type { ThemeColors } from "./themeColors";

type Ink = "ringDark" | "ringLight" | "ringMade" | "ringRemoved";

interface OutlineStyle extends StrokeStyle {
  readonly casing: number;
  /** The colours of the line and of its casing. */
  readonly inks: readonly [line: Ink, casing: Ink];
}

export type OutlineName = "lit" | "selected" | "removed" | "hover" | "made";

/** Outlines by what they say; drawn in this order. */
export const OUTLINES: Readonly<Record<OutlineName, OutlineStyle>> = {
  lit: { width: 1.2, casing: 3.2, behind: 0.5, inks: ["ringDark", "ringLight"] },
  removed: { width: 2.2, casing: 4.6, dash: 5, behind: 0.7, inks: ["ringRemoved", "ringDark"] },
  selected: { width: 2.4, casing: 5.6, behind: 1, inks: ["ringLight", "ringDark"] },
  hover: { width: 1.8, casing: 4.2, behind: 0.5, inks: ["ringDark", "ringLight"] },
  made: { width: 2.2, casing: 4.6, dash: 5, behind: 0.7, inks: ["ringMade", "ringDark"] },
};

export function dressed(name: OutlineName, ink: ThemeColors): Strokes {
  const [line, casing] = outlineColors(name, ink);
  return new Strokes(line, { ...OUTLINES[name], cut: true }, 2, casing);
}

/** The colours of the line and of its casing in a theme. */
export function outlineColors(name: OutlineName, ink: ThemeColors): [line: Color, casing: Color] {
  const [line, casing] = OUTLINES[name].inks;
  return [ink[line], ink[casing]];
}
