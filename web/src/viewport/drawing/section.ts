// How a section plane shows: shaders leave out what is beyond it, hulls that it cuts are closed by hatched faces, and a
// frame shows where it is. The plane that cuts a hull in two is drawn by `cutPlane.ts`.
import { BufferAttribute, BufferGeometry, Group, Matrix4, Mesh, Plane, Vector3 } from "three";
import type { Outline } from "../geometry/edges";
import { axesIn, cutPolygon } from "../geometry/section";
import type { Point } from "../geometry/triangles";
import { type SectionPlane, spanOfBox } from "../../store/section";
import { ORIGIN, plus } from "../../store/vectors";
import type { HullSet } from "./hullSet";
import { sectionFaceMaterial } from "./hullShader";
import { type Frame, linesBetween, Strokes } from "./strokes";
import type { ThemeColors } from "./themeColors";

/** As three.js clips: it keeps what is on the side that the normal points to. */
export function clippingPlane({ normal, at }: SectionPlane): Plane {
  return new Plane(new Vector3(...normal).negate(), at);
}

/** The plane in a frame from which a matrix of a turn and a shift leads to the plane's own. */
export function planeIn({ normal, at }: SectionPlane, matrix: Matrix4): SectionPlane {
  const turned = new Vector3(...normal).transformDirection(matrix.clone().invert());
  const shift = new Vector3().setFromMatrixPosition(matrix).dot(new Vector3(...normal));
  return { normal: turned.toArray(), at: at - shift };
}

type Segment = readonly [Point, Point];

/** The faces that close the hulls of a set where a plane cuts them, with their contours. */
export class SectionFaces {
  readonly object = new Group();
  private readonly mesh: Mesh;
  private readonly contour: Strokes;
  private readonly selected: Strokes;
  private written = "";

  constructor(
    private readonly hulls: HullSet,
    ink: ThemeColors,
  ) {
    this.mesh = new Mesh(new BufferGeometry(), sectionFaceMaterial(hulls.common));
    this.mesh.frustumCulled = false;
    this.contour = new Strokes(ink.text, { width: 1.2 });
    this.selected = new Strokes(ink.selected, { width: 2.6 });
    this.object.add(this.mesh, this.contour.object, this.selected.object);
    this.object.visible = false;
  }

  /** Where they are drawn, null where there are none. */
  get geometry(): BufferGeometry | null {
    return this.object.visible ? this.mesh.geometry : null;
  }

  /** plane: in the frame of the file; selection: hulls with a stronger contour. */
  set(plane: SectionPlane | null, explode: number, selection: ReadonlySet<string>): void {
    this.object.visible = plane !== null;
    const key = JSON.stringify([plane, explode, [...selection], this.hulls.visible]);
    if (!plane || key === this.written) return;
    this.written = key;
    const found = this.hulls.names.map((_, k) => this.polygon(k, plane, explode));
    this.mesh.geometry.dispose();
    this.mesh.geometry = fans(found, plane.normal);
    const sides = (take: (name: string) => boolean) =>
      found.flatMap((corners, k) => (take(this.hulls.names[k] ?? "") ? sidesOf(corners) : []));
    this.contour.set(linesBetween(sides((name) => !selection.has(name))));
    this.selected.set(linesBetween(sides((name) => selection.has(name))));
  }

  setInk(ink: ThemeColors): void {
    this.contour.recolor(ink.text);
    this.selected.recolor(ink.selected);
  }

  measure(frame: Frame): void {
    if (!this.object.visible) return;
    this.contour.measure(frame);
    this.selected.measure(frame);
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.contour.dispose();
    this.selected.dispose();
  }

  private polygon(k: number, plane: SectionPlane, explode: number): Point[] {
    if (!this.hulls.visible[k]) return [];
    return cutPolygon(this.hulls.shapes, k, plane, plus(ORIGIN, this.hulls.aways[k] ?? ORIGIN, explode));
  }
}

/** The sides of a polygon. */
export const sidesOf = (corners: readonly Point[]): Segment[] =>
  corners.map((corner, k): Segment => [corner, corners[(k + 1) % corners.length] ?? corner]);

/** Of hulls that overlap, the later one lies above by so much of the whole extent. */
const LAYER = 2e-4;

/** A fan of triangles for each polygon; each vertex knows the hull that it belongs to. */
function fans(polygons: readonly (readonly Point[])[], normal: Point): BufferGeometry {
  const corners = polygons.flatMap((polygon, k) => polygon.map((at) => ({ at, k })));
  const size = Math.max(0, ...corners.map(({ at }) => Math.hypot(...at)));
  const lift = (k: number) => (LAYER * size * (k + 1)) / polygons.length;
  const index: number[] = [];
  let first = 0;
  for (const polygon of polygons) {
    for (let c = 2; c < polygon.length; c++) index.push(first, first + c - 1, first + c);
    first += polygon.length;
  }
  const out = new BufferGeometry();
  const rows = (numbers: number[], wide: number) => new BufferAttribute(new Float32Array(numbers), wide);
  out.setAttribute("position", rows(corners.flatMap(({ at, k }) => at.map((value, axis) => value + lift(k) * (normal[axis] ?? 0))), 3));
  out.setAttribute("normal", rows(corners.flatMap(() => [...normal]), 3));
  out.setAttribute("owner", rows(corners.map(({ k }) => k), 1));
  out.setAttribute("away", rows(corners.flatMap(() => [0, 0, 0]), 3));
  out.setIndex(index);
  return out;
}

/** The frame of the plane around all that is shown, given by its box; none without a plane. */
export const frameOf = (plane: SectionPlane | null, box: readonly number[]): Outline[] => (plane ? linesBetween(sidesOf(frameCorners(plane, box))) : []);

const MARGIN = 0.06;

/** The corners of a rectangle in the plane, a little larger than what is shown. */
export function frameCorners({ normal, at }: SectionPlane, box: readonly number[]): Point[] {
  const { u, v } = axesIn(normal);
  const reach = (axis: Point): [number, number] => {
    const [low, high] = spanOfBox(box, [...axis]);
    const more = MARGIN * (high - low);
    return [low - more, high + more];
  };
  const [us, vs] = [reach(u), reach(v)];
  const corner = (a: number, b: number): Point => plus(plus(plus(ORIGIN, normal, at), u, a), v, b);
  return [corner(us[0], vs[0]), corner(us[1], vs[0]), corner(us[1], vs[1]), corner(us[0], vs[1])];
}
