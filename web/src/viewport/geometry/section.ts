// Hulls that a section plane cuts open: the polygon of the cut, and what a ray meets where one side is out of sight.
import type { SectionPlane } from "../../store/section";
import { castRay, type Ray, type RayHit } from "./ray";
import type { MergedShapes, Point } from "./triangles";

/** Hulls as they are drawn: which are in sight, and where the exploded view moves them. */
export interface PlacedShapes {
  readonly shapes: MergedShapes;
  readonly visible: readonly boolean[];
  readonly aways: readonly Point[];
}

/** How far a point is beyond the plane, on the side that is out of sight [m]. */
export const beyond = ({ normal, at }: SectionPlane, [x, y, z]: Point): number =>
  normal[0] * x + normal[1] * y + normal[2] * z - at;

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
      if (h > 0 && i <= 0) out.push(between(a, b, h / (h - i)));
    });
  }
  return inOrder(out, plane.normal);
}

function cornerOf({ positions, index }: MergedShapes, corner: number, off: Point): Point {
  const v = 3 * (index[corner] ?? 0);
  return [(positions[v] ?? 0) + off[0], (positions[v + 1] ?? 0) + off[1], (positions[v + 2] ?? 0) + off[2]];
}

const between = (a: Point, b: Point, t: number): Point => [
  a[0] + t * (b[0] - a[0]),
  a[1] + t * (b[1] - a[1]),
  a[2] + t * (b[2] - a[2]),
];

/** Corners of a convex polygon by their angle about its middle. */
function inOrder(corners: readonly Point[], normal: Point): Point[] {
  if (corners.length < 3) return [];
  const sum = (axis: 0 | 1 | 2) => corners.reduce((total, corner) => total + corner[axis], 0) / corners.length;
  const middle: Point = [sum(0), sum(1), sum(2)];
  const { u, v } = axesIn(normal);
  const along = (p: Point, axis: Point) => axis.reduce((total, value, k) => total + value * ((p[k] ?? 0) - (middle[k] ?? 0)), 0);
  return corners
    .map((corner) => ({ corner, angle: Math.atan2(along(corner, v), along(corner, u)) }))
    .sort((a, b) => a.angle - b.angle)
    .map(({ corner }) => corner);
}

/** Two directions of length one in the plane of a normal of length one, square to each other. */
export function axesIn([x, y, z]: Point): { u: Point; v: Point } {
  const raw: Point = Math.abs(z) < 0.9 ? [-y, x, 0] : [0, -z, y];
  const length = Math.hypot(...raw);
  const u: Point = [raw[0] / length, raw[1] / length, raw[2] / length];
  return { u, v: [y * u[2] - z * u[1], z * u[0] - x * u[2], x * u[1] - y * u[0]] };
}

/** The first shape on a ray, of what is in sight on this side of a plane; also where the ray meets the inside of one. */
export function castThrough(placed: PlacedShapes, ray: Ray, explode: number, plane: SectionPlane | null): RayHit | null {
  const { shapes, visible, aways } = placed;
  const cast = (from: Point) => castRay(shapes, { from, along: ray.along }, visible, aways, explode);
  if (!plane) return cast(ray.from);
  const height = beyond(plane, ray.from);
  const climb = plane.normal[0] * ray.along[0] + plane.normal[1] * ray.along[1] + plane.normal[2] * ray.along[2];
  if (height <= 0) {
    const met = cast(ray.from);
    return met && climb > 0 && met.distance > -height / climb ? null : met;
  }
  if (climb >= 0) return null;
  const start = -height / climb;
  const from = between(ray.from, [ray.from[0] + ray.along[0], ray.from[1] + ray.along[1], ray.from[2] + ray.along[2]], start);
  const place = shapeAround(placed, from, explode);
  if (place >= 0) return { place, distance: start };
  const met = cast(from);
  return met && { ...met, distance: met.distance + start };
}

/** The last shape in sight that a point is in, as that one is drawn above the others; -1 for none. */
function shapeAround({ shapes, visible, aways }: PlacedShapes, [x, y, z]: Point, explode: number): number {
  for (let k = shapes.count - 1; k >= 0; k--) {
    const away = aways[k] ?? [0, 0, 0];
    if (visible[k] && contains(shapes, k, [x - explode * away[0], y - explode * away[1], z - explode * away[2]])) return k;
  }
  return -1;
}

const NOWHERE: Point = [0, 0, 0];

/** Whether a point is in a convex shape. */
export function contains(shapes: MergedShapes, k: number, point: Point): boolean {
  const box = shapes.boxes.subarray(6 * k, 6 * k + 6);
  if (point.some((value, axis) => value < (box[axis] ?? 0) || value > (box[axis + 3] ?? 0))) return false;
  const end = shapes.faces[k + 1] ?? 0;
  for (let face = shapes.faces[k] ?? 0; face < end; face++) {
    const [a, b, c] = [0, 1, 2].map((corner) => cornerOf(shapes, 3 * face + corner, NOWHERE)) as [Point, Point, Point];
    const [u, v, w] = [minus(b, a), minus(c, a), minus(point, a)];
    const volume =
      w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0]);
    if (volume > 0) return false;
  }
  return true;
}

const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
