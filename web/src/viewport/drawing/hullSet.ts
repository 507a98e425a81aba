// All hulls of a scene as three.js objects: one mesh, its edges, and tables of colours and states.
import { BufferAttribute, BufferGeometry, type Color, Group, LineSegments, Mesh, ShaderMaterial, type ShaderMaterialParameters } from "three";
import { EDGE, type Edges, edgesOf, type Outline } from "../geometry/edges";
import { facetsOf, joinShapes, type MergedShapes, mergeShapes, middleOf, type Point } from "../geometry/triangles";
import type { Fill } from "../../pictures/hullColors";
import type { Shape } from "../../server/packet";
import { oncePer } from "../../store/once";
import { minus, ORIGIN, plus } from "../../store/vectors";
import { ByteTable, FILL_BYTES, hullMaterial, lineMaterial, placeUniforms, type SharedUniforms, shareUniforms } from "./hullShader";
import type { ThemeColors } from "./themeColors";

/** How one hull looks. role: one of ROLE; selected, hover: 0 to 1. */
export interface HullLook {
  readonly color: Color;
  readonly fill: Fill;
  readonly visible: boolean;
  readonly selected: number;
  readonly hover: number;
  readonly role: number;
}

export class HullSet {
  readonly object = new Group();
  readonly names: readonly string[];
  readonly places: ReadonlyMap<string, number>;
  readonly shapes: MergedShapes;
  readonly middles: readonly Point[];
  readonly aways: readonly Point[];
  readonly visible: boolean[];
  readonly common: SharedUniforms;
  readonly faceGeometry: BufferGeometry;
  private readonly colors: ByteTable;
  private readonly states: ByteTable;
  readonly edges: readonly Edges[];
  private readonly faces: Mesh;
  private readonly lines: LineSegments;
  private readonly wire = { value: 0 };
  private readonly sharp: number;

  /** centre: what hulls move away from in the exploded view; translucent hulls are in front of others with the same faces. */
  constructor(hulls: readonly { name: string; shape: Shape }[], centre: Point, ink: ThemeColors, opacity = 1) {
    this.names = hulls.map((hull) => hull.name);
    this.places = new Map(this.names.map((name, k) => [name, k]));
    this.shapes = mergeShapes(hulls.map((hull) => hull.shape));
    this.middles = hulls.map((_, k) => middleOf(this.shapes.boxes, k));
    this.aways = this.middles.map((at) => minus(at, centre));
    this.visible = hulls.map(() => true);
    this.edges = hulls.map((hull) => cachedEdges(hull.shape));
    this.colors = new ByteTable(hulls.length, true);
    this.states = new ByteTable(hulls.length, false);
    this.common = shareUniforms(this.colors, this.states, ink);
    const front = opacity < 1;
    const places = { aways: this.aways, layers: this.shapes.layers.map((layer) => (front ? 0 : layer + 1)) };
    this.faceGeometry = faceGeometry(hulls.map((hull) => hull.shape), places);
    this.faces = new Mesh(this.faceGeometry, hullMaterial(this.common, opacity));
    const lines = lineGeometry(this.edges, places);
    this.sharp = lines.sharp;
    this.lines = new LineSegments(lines.geometry, lineMaterial(this.common, this.wire));
    this.lines.renderOrder = 1;
    for (const one of [this.faces, this.lines]) {
      one.frustumCulled = false;
      this.object.add(one);
    }
    this.setWireframe(false, false);
  }

  /** The faces where they are, as other shaders draw them; these have PLACE_VERTEX. */
  facesWith(vertexShader: string, fragmentShader: string, geometry = this.faceGeometry, more: ShaderMaterialParameters = {}): Mesh {
    const out = new Mesh(geometry, new ShaderMaterial({ vertexShader, fragmentShader, uniforms: placeUniforms(this.common), ...more }));
    out.frustumCulled = false;
    out.matrixAutoUpdate = false;
    out.matrix.copy(this.object.matrixWorld);
    return out;
  }

  paint(look: (k: number) => HullLook): void {
    this.names.forEach((_, k) => {
      const { color, fill, visible, selected, hover, role } = look(k);
      const [r, g, b] = bytes(color);
      this.colors.set(k, r, g, b, FILL_BYTES[fill]);
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

  setInk(ink: ThemeColors): void {
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
    return plus(this.middles[k] ?? ORIGIN, this.aways[k] ?? ORIGIN, explode);
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
const cachedEdges = oncePer(edgesOf);
const cachedFacets = oncePer(facetsOf);

const bytes = (color: Color): [number, number, number] => {
  const hex = color.getHex();
  return [hex >> 16, (hex >> 8) & 255, hex & 255];
};

/** Of each hull, where it drifts in the exploded view, and its layer. */
interface Places {
  readonly aways: readonly Point[];
  readonly layers: Float32Array;
}

/** Faces of all hulls; each vertex knows the place of its hull, where that drifts in the exploded view, and its layer. */
function faceGeometry(shapes: readonly Shape[], places: Places): BufferGeometry {
  const parts = shapes.map(cachedFacets);
  const { positions, owner, index } = joinShapes(parts);
  const normals = new Float32Array(positions.length);
  let first = 0;
  for (const part of parts) {
    normals.set(part.normals, first);
    first += part.normals.length;
  }
  const out = geometryOf(positions, owner, places);
  out.setAttribute("normal", new BufferAttribute(normals, 3));
  out.setIndex(new BufferAttribute(index, 1));
  return out;
}

/** Lines of all hulls; sharp: how many vertices those of the sharp edges have. */
function lineGeometry(edges: readonly Edges[], places: Places): { geometry: BufferGeometry; sharp: number } {
  const total = edges.reduce((sum, { records }) => sum + records.length / EDGE, 0);
  const ends = new Float32Array(6 * total);
  const owner = new Float32Array(2 * total);
  let at = 0;
  const add = (k: number, records: Float32Array, first: number, last: number) => {
    for (let e = first; e < last; e++, at++) {
      ends.set(records.subarray(e * EDGE, e * EDGE + 6), 6 * at);
      owner.fill(k, 2 * at, 2 * at + 2);
    }
  };
  edges.forEach(({ records, sharp }, k) => add(k, records, 0, sharp));
  const sharp = 2 * at;
  edges.forEach(({ records, sharp: first }, k) => add(k, records, first, records.length / EDGE));
  return { geometry: geometryOf(ends, owner, places), sharp };
}

function geometryOf(positions: Float32Array, owner: Float32Array, { aways, layers }: Places): BufferGeometry {
  const away = new Float32Array(positions.length);
  for (let v = 0; v < owner.length; v++) away.set(aways[owner[v] ?? 0] ?? [0, 0, 0], 3 * v);
  const out = new BufferGeometry();
  out.setAttribute("position", new BufferAttribute(positions, 3));
  out.setAttribute("owner", new BufferAttribute(owner, 1));
  out.setAttribute("away", new BufferAttribute(away, 3));
  out.setAttribute("layer", new BufferAttribute(owner.map((k) => layers[k] ?? 0), 1));
  return out;
}
