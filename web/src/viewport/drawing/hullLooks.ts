// How each hull looks, from what is selected, pointed at, hidden, changed and about to change.
import { Color } from "three";
import type { Tone } from "../../pictures/hullColors";
import type { Scene } from "../../store/scenes";
import type { HullView } from "../../wire";
import type { HullLook } from "./hullSet";
import { ROLE } from "./hullShader";
import type { ThemeColors } from "./themeColors";

/** What decides the looks of one side of the picture. */
export interface Appearance {
  readonly tone: (hull: HullView) => Tone;
  readonly selection: ReadonlySet<string>;
  readonly hover: string | null;
  /** Pointed out from elsewhere: by a rule, a thumbnail, a region that is being drawn. */
  readonly lit: ReadonlySet<string>;
  readonly hidden: ReadonlySet<string>;
  /** What the action in hand would take away. */
  readonly going: ReadonlySet<string>;
  /** What was changed, so that all else is paler; null where nothing is compared. */
  readonly changed: ReadonlySet<string> | null;
  readonly ink: ThemeColors;
}

export function hullLooks(scene: Scene, now: Appearance): HullLook[] {
  return scene.hulls.map((hull) => {
    const { color, fill } = now.tone(hull);
    return {
      color: color === null ? now.ink.unlabelled : colorOf(color),
      fill,
      visible: !now.hidden.has(hull.name),
      selected: now.selection.has(hull.name) ? 1 : 0,
      hover: now.hover === hull.name ? 1 : now.lit.has(hull.name) ? 0.7 : 0,
      role: roleOf(hull.name, now),
    };
  });
}

function roleOf(name: string, { going, changed }: Appearance): number {
  if (going.has(name)) return ROLE.removed;
  return changed && !changed.has(name) ? ROLE.washed : ROLE.plain;
}

const known = new Map<string, Color>();

/** A colour of the page as three.js needs it. */
export function colorOf(hex: string): Color {
  const color = known.get(hex) ?? new Color(hex);
  known.set(hex, color);
  return color;
}
