// Hulls that a section plane cuts open: the polygon of the cut, and what a ray meets where one side is out of sight.
import type { SectionPlane } from "../../store/section";
import { cross, dot, minus, ORIGIN, plus } from "../../store/vectors";
import { castRay, type Ray, type RayHit } from "./ray";
import type { MergedShapes, Point } from "./triangles";

/** Hulls as they are drawn: which are in sight, and where the exploded view moves them. */
export interface PlacedShapes {
  readonly shapes: MergedShapes;
  readonly visible: readonly boolean[];
  readonly aways: readonly Point[];
}

/** How far a point is beyond the plane, on the side that is out of sight [m]. */
export const beyond = ({ normal, at }: SectionPlane, point: Point): number => dot(normal, point) - at;

/** Where a plane cuts a convex shape that was moved by `off`: the corners in order; none where it does not. */
export function cutPolygon(shapes: MergedShapes, k: number, plane: SectionPlane, off: Point): Point[] {
  const out: Point[] = [];
  const end = shapes.faces[k + 1] ?? 0;
  for (let face = shapes.faces[k] ?? 0; face < end; face++) {
    const corners = [0, 1, 2].map((c) => cornerOf(shapes, 3 * face + c, off));
    corners.forEach((a, c) => {
      const b = corners[(c + 1) % 3] ?? a;
      const [h, i] = [beyond(plane, a), beyond(plane, b)];
      // each edge is met once from either side; one of these is enough
      if (h > 0 && i <= 0) out.push(plus(a, minus(b, a), h / (h - i)));
    });
  }
  return inOrder(out, plane.normal);
}

function cornerOf({ positions, index }: MergedShapes, corner: number, off: Point): Point {
  const v = 3 * (index[corner] ?? 0);
  return plus([positions[v] ?? 0, positions[v + 1] ?? 0, positions[v + 2] ?? 0], off);
}

/** Corners of a convex polygon by their angle about its middle. */
function inOrder(corners: readonly Point[], normal: Point): Point[] {
  if (corners.length < 3) return [];
  const sum = (axis: 0 | 1 | 2) => corners.reduce((total, corner) => total + corner[axis], 0) / corners.length;
  const middle: Point = [sum(0), sum(1), sum(2)];
  const { u, v } = axesIn(normal);
  const along = (p: Point, axis: Point) => dot(minus(p, middle), axis);
  return corners
    .map((corner) => ({ corner, angle: Math.atan2(along(corner, v), along(corner, u)) }))
    .sort((a, b) => a.angle - b.angle)
    .map(({ corner }) => corner);
}

/** Two directions of length one in the plane of a normal of length one, square to each other. */
export function axesIn(normal: Point): { u: Point; v: Point } {
  const [x, y, z] = normal;
  const raw: Point = Math.abs(z) < 0.9 ? [-y, x, 0] : [0, -z, y];
  const u = plus(ORIGIN, raw, 1 / Math.hypot(...raw));
  return { u, v: cross(normal, u) };
}

/** The first shape on a ray, of what is in sight on this side of a plane; also where the ray meets the inside of one. */
export function castThrough(placed: PlacedShapes, ray: Ray, explode: number, plane: SectionPlane | null): RayHit | null {
  const { shapes, visible, aways } = placed;
  const cast = (from: Point) => castRay(shapes, { from, along: ray.along }, visible, aways, explode);
  if (!plane) return cast(ray.from);
  const height = beyond(plane, ray.from);
  const climb = dot(plane.normal, ray.along);
  if (height <= 0) {
    const met = cast(ray.from);
    return met && climb > 0 && met.distance > -height / climb ? null : met;
  }
  if (climb >= 0) return null;
  const start = -height / climb;
  const from = plus(ray.from, ray.along, start);
  const place = shapeAround(placed, from, explode);
  if (place >= 0) return { place, distance: start };
  const met = cast(from);
  return met && { ...met, distance: met.distance + start };
}

/** The last shape in sight that a point is in, as that one is drawn above the others; -1 for none. */
function shapeAround({ shapes, visible, aways }: PlacedShapes, point: Point, explode: number): number {
  for (let k = shapes.count - 1; k >= 0; k--) {
    if (visible[k] && contains(shapes, k, plus(point, aways[k] ?? ORIGIN, -explode))) return k;
  }
  return -1;
}

/** Whether a point is in a convex shape. */
export function contains(shapes: MergedShapes, k: number, point: Point): boolean {
  const box = shapes.boxes.subarray(6 * k, 6 * k + 6);
  if (point.some((value, axis) => value < (box[axis] ?? 0) || value > (box[axis + 3] ?? 0))) return false;
  const end = shapes.faces[k + 1] ?? 0;
  for (let face = shapes.faces[k] ?? 0; face < end; face++) {
    const [a, b, c] = [0, 1, 2].map((corner) => cornerOf(shapes, 3 * face + corner, ORIGIN)) as [Point, Point, Point];
    if (dot(minus(point, a), cross(minus(b, a), minus(c, a))) > 0) return false;
  }
  return true;
}
