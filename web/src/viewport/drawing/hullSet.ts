// All hulls of a scene as three.js objects: one mesh, its edges, and tables of colours and states.
import { type BufferGeometry, Group, LineSegments, Mesh, type Color } from "three";
import type { Shape } from "../../server/packet";
import { type Edges, edgesOf } from "../shapes/edges";
import type { Outline } from "../shapes/silhouette";
import { merged, middleOf, type Merged, type Point } from "../shapes/merged";
import { faceGeometry, lineGeometry } from "./hullGeometry";
import { hullMaterial, shared, type Shared } from "./hullShader";
import type { Ink } from "./ink";
import { lineMaterial } from "./lineShader";
import { Table } from "./table";

/** How one hull looks. role: one of ROLE; selected, hover: 0 to 1. */
export interface Look {
  readonly color: Color;
  readonly hatched: boolean;
  readonly visible: boolean;
  readonly selected: number;
  readonly hover: number;
  readonly role: number;
}

export class HullSet {
  readonly object = new Group();
  readonly names: readonly string[];
  readonly places: ReadonlyMap<string, number>;
  readonly shapes: Merged;
  readonly middles: readonly Point[];
  readonly aways: readonly Point[];
  readonly visible: boolean[];
  readonly common: Shared;
  readonly faceGeometry: BufferGeometry;
  private readonly colors: Table;
  private readonly states: Table;
  private readonly edges: readonly Edges[];
  private readonly faces: Mesh;
  private readonly lines: LineSegments;
  private readonly wire = { value: 0 };
  private readonly sharp: number;

  /** centre: what hulls move away from in the exploded view. */
  constructor(hulls: readonly { name: string; shape: Shape }[], centre: Point, ink: Ink, opacity = 1) {
    this.names = hulls.map((hull) => hull.name);
    this.places = new Map(this.names.map((name, k) => [name, k]));
    this.shapes = merged(hulls.map((hull) => hull.shape));
    this.middles = hulls.map((_, k) => middleOf(this.shapes.boxes, k));
    this.aways = this.middles.map((at) => [at[0] - centre[0], at[1] - centre[1], at[2] - centre[2]] as const);
    this.visible = hulls.map(() => true);
    this.edges = hulls.map((hull) => keptEdges(hull.shape));
    this.colors = new Table(hulls.length, true);
    this.states = new Table(hulls.length, false);
    this.common = shared(this.colors, this.states, ink);
    this.faceGeometry = faceGeometry(hulls.map((hull) => hull.shape), this.aways);
    this.faces = new Mesh(this.faceGeometry, hullMaterial(this.common, opacity));
    const lines = lineGeometry(this.edges, this.aways);
    this.sharp = lines.sharp;
    this.lines = new LineSegments(lines.geometry, lineMaterial(this.common, this.wire));
    this.lines.renderOrder = 1;
    for (const one of [this.faces, this.lines]) {
      one.frustumCulled = false;
      this.object.add(one);
    }
    this.setWireframe(false, false);
  }

  paint(look: (k: number) => Look): void {
    this.names.forEach((_, k) => {
      const { color, hatched, visible, selected, hover, role } = look(k);
      const [r, g, b] = bytes(color);
      this.colors.set(k, r, g, b, hatched ? 0 : 255);
      this.states.set(k, visible ? 255 : 0, 255 * selected, role, 255 * hover);
      this.visible[k] = visible;
    });
    this.colors.changed();
    this.states.changed();
  }

  get sharpEdges(): number {
    return this.sharp / 2;
  }

  /** bare: faces only, if they are drawn. */
  setWireframe(on: boolean, bare: boolean): void {
    this.wire.value = on ? 1 : 0;
    this.faces.visible = !on;
    this.lines.visible = on || !bare;
    this.lines.geometry.setDrawRange(0, on ? Infinity : this.sharp);
  }

  setInk(ink: Ink): void {
    this.common.ink.tint.value = ink.selected;
    this.common.ink.pale.value = ink.pale;
    this.common.ink.removed.value = ink.removed;
  }

  measure(pixel: number, explode: number): void {
    this.common.pixel.value = pixel;
    this.common.explode.value = explode;
  }

  /** The outlines of some hulls that are in sight. */
  outlines(names: Iterable<string>): Outline[] {
    const places = [...names].flatMap((name) => this.places.get(name) ?? []);
    return places
      .filter((k) => this.visible[k])
      .map((k) => ({ records: this.edges[k]?.records ?? NOTHING, away: this.aways[k] ?? [0, 0, 0] }));
  }

  /** Where the middle of a hull is in the exploded view, in the frame of the file. */
  middle(k: number, explode: number): Point {
    const [m, a] = [this.middles[k] ?? [0, 0, 0], this.aways[k] ?? [0, 0, 0]];
    return [m[0] + explode * a[0], m[1] + explode * a[1], m[2] + explode * a[2]];
  }

  /** Materials stay: the last one of a kind would take its compiled shader along. */
  dispose(): void {
    this.colors.dispose();
    this.states.dispose();
    this.faces.geometry.dispose();
    this.lines.geometry.dispose();
  }
}

const NOTHING = new Float32Array(0);
const known = new WeakMap<Shape, Edges>();

function keptEdges(shape: Shape): Edges {
  const edges = known.get(shape) ?? edgesOf(shape);
  known.set(shape, edges);
  return edges;
}

const bytes = (color: Color): [number, number, number] => {
  const hex = color.getHex();
  return [hex >> 16, (hex >> 8) & 255, hex & 255];
};
