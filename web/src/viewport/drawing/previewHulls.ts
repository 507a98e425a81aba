// The hulls that the action in hand would make: green, translucent, with dashed outlines.
import { Group } from "three";
import type { EditedPacket } from "../../server/packet";
import type { Point } from "../geometry/triangles";
import { HullSet } from "./hullSet";
import { ROLE } from "./hullShader";
import { dressed } from "./outlines";
import { type Frame, type Strokes } from "./strokes";
import type { ThemeColors } from "./themeColors";

export class PreviewHulls {
  readonly object = new Group();
  private readonly hulls: HullSet;
  private readonly outlines: Strokes;

  constructor(preview: EditedPacket, centre: Point, ink: ThemeColors) {
    const made = new Set(preview.header.made);
    const rows = preview.rows.flatMap((row, k) => {
      const shape = preview.shapes[k];
      return shape && made.has(row.name) ? [{ name: row.name, shape }] : [];
    });
    this.hulls = new HullSet(rows, centre, ink, 0.42);
    const look = { color: ink.preview, fill: "solid" as const, visible: true, selected: 0, hover: 0, role: ROLE.plain };
    this.hulls.paint(() => look);
    this.outlines = dressed("made", ink);
    this.outlines.set(this.hulls.outlines(this.hulls.names));
    this.object.add(this.hulls.object, this.outlines.object);
  }

  measure(frame: Frame): void {
    this.hulls.measure(frame.pixel, frame.explode);
    this.outlines.measure(frame);
  }

  dispose(): void {
    this.hulls.dispose();
    this.outlines.dispose();
  }
}

/** The hulls of what is shown that a preview takes away, or makes anew under the same name. */
export function hullsToRemove(preview: EditedPacket | null, names: readonly string[]): ReadonlySet<string> {
  if (!preview) return new Set();
  const left = new Set(preview.header.hulls.map((hull) => hull.name));
  const made = new Set(preview.header.made);
  return new Set(names.filter((name) => !left.has(name) || made.has(name)));
}
