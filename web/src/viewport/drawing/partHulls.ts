// The parts of a hull that likely spans them, each in the colour of its label, and the outline of the hull around them.
import { Group } from "three";
import type { PartsPacket } from "../../server/packet";
import type { Tone } from "../../pictures/hullColors";
import type { SceneHull } from "../../store/scene";
import type { HullView } from "../../wire";
import type { Point } from "../geometry/triangles";
import { colorOf } from "./hullLooks";
import { HullSet } from "./hullSet";
import { ROLE } from "./hullShader";
import { dressed } from "./outlines";
import type { Frame, Strokes } from "./strokes";
import type { ThemeColors } from "./themeColors";

export class PartHulls {
  readonly object = new Group();
  private readonly parts: HullSet;
  private readonly whole: HullSet;
  private readonly outline: Strokes;

  constructor(packet: PartsPacket, hull: SceneHull, centre: Point, private readonly tone: (hull: HullView) => Tone, ink: ThemeColors) {
    const rows = packet.rows.flatMap((row, k) => {
      const shape = packet.shapes[k];
      return shape ? [{ name: row.name, shape }] : [];
    });
    this.parts = new HullSet(rows, centre, ink);
    this.whole = new HullSet([hull], centre, ink);
    this.outline = dressed("selected", ink);
    this.outline.set(this.whole.outlines([hull.name]));
    this.paint(packet.header.parts, ink);
    this.object.add(this.parts.object, this.outline.object);
  }

  private paint(parts: readonly HullView[], ink: ThemeColors): void {
    this.parts.paint((k) => {
      const part = parts[k];
      const color = part ? this.tone(part).color : null;
      return { color: color === null ? ink.unlabelled : colorOf(color), hatched: false, visible: true, selected: 0, hover: 0, role: ROLE.plain };
    });
  }

  measure(frame: Frame): void {
    this.parts.measure(frame.pixel, frame.explode);
    this.outline.measure(frame);
  }

  dispose(): void {
    this.parts.dispose();
    this.whole.dispose();
    this.outline.dispose();
  }
}
