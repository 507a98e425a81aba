// Which shape a ray meets first: boxes are tried before triangles, so hundreds of hulls take no time.
import type { MergedShapes, Point } from "./triangles";

/** from, along: in the frame of the shapes. */
export interface Ray {
  readonly from: Point;
  readonly along: Point;
}

export interface RayHit {
  readonly place: number;
  /** How far along the ray, in lengths of `along`. */
  readonly distance: number;
}

/** Faces that a ray meets nearer to each other than this share of the way lie in one plane. */
const SAME = 1e-5;

/**
 * The first shape on a ray among those that are in sight; of those with faces in one plane, the one that is drawn in
 * front. aways, explode: how shapes are moved.
 */
export function castRay(
  shapes: MergedShapes,
  ray: Ray,
  visible: readonly boolean[],
  aways: readonly Point[],
  explode: number,
): RayHit | null {
  let best: RayHit | null = null;
  for (let k = 0; k < shapes.count; k++) {
    if (!visible[k]) continue;
    const last = best?.distance ?? Infinity;
    const distance = distanceTo(shapes, k, ray, aways, explode, last * (1 + SAME));
    if (isBefore(shapes.layers, k, distance, best)) best = { place: k, distance };
  }
  return best;
}

function isBefore(layers: Float32Array, place: number, distance: number, best: RayHit | null): boolean {
  if (distance === Infinity) return false;
  if (!best || distance < best.distance * (1 - SAME)) return true;
  return distance <= best.distance * (1 + SAME) && (layers[place] ?? 0) < (layers[best.place] ?? 0);
}

/** All shapes on a ray among those that are in sight, the first one first. */
export function castRayThrough(
  shapes: MergedShapes,
  ray: Ray,
  visible: readonly boolean[],
  aways: readonly Point[],
  explode: number,
): RayHit[] {
  const all = Array.from({ length: shapes.count }, (_, place) => place).filter((place) => visible[place]);
  const hits = all.map((place) => ({ place, distance: distanceTo(shapes, place, ray, aways, explode, Infinity) }));
  const first = ({ distance, place }: RayHit, other: RayHit) =>
    Math.abs(distance - other.distance) <= SAME * distance ? (shapes.layers[place] ?? 0) - (shapes.layers[other.place] ?? 0) : distance - other.distance;
  return hits.filter(({ distance }) => distance < Infinity).sort(first);
}

/** How far along a ray a shape is met; Infinity where it is not, or not within a limit. */
function distanceTo(shapes: MergedShapes, k: number, ray: Ray, aways: readonly Point[], explode: number, limit: number): number {
  const away = aways[k] ?? ZERO;
  const from: Point = [
    ray.from[0] - explode * away[0],
    ray.from[1] - explode * away[1],
    ray.from[2] - explode * away[2],
  ];
  return hitsBox(shapes.boxes, k, from, ray.along, limit) ? nearestFace(shapes, k, from, ray.along) : Infinity;
}

const ZERO: Point = [0, 0, 0];

function hitsBox(boxes: Float32Array, k: number, from: Point, along: Point, limit: number): boolean {
  let [near, far] = [0, limit];
  for (let axis = 0; axis < 3; axis++) {
    const [o, d] = [from[axis] ?? 0, along[axis] ?? 0];
    const [low, high] = [boxes[6 * k + axis] ?? 0, boxes[6 * k + axis + 3] ?? 0];
    if (Math.abs(d) < 1e-12) {
      if (o < low || o > high) return false;
      continue;
    }
    const [a, b] = [(low - o) / d, (high - o) / d];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
    if (near > far) return false;
  }
  return true;
}

function nearestFace({ positions, index, faces }: MergedShapes, k: number, from: Point, along: Point): number {
  let best = Infinity;
  const end = faces[k + 1] ?? 0;
  for (let face = faces[k] ?? 0; face < end; face++) {
    const t = faceDistance(positions, index, 3 * face, from, along);
    if (t < best) best = t;
  }
  return best;
}

/** How far along a ray a triangle is met (Möller and Trumbore, 1997); Infinity where it is not. */
function faceDistance(p: Float32Array, index: Uint32Array, corner: number, o: Point, d: Point): number {
  const [a, b, c] = [3 * (index[corner] ?? 0), 3 * (index[corner + 1] ?? 0), 3 * (index[corner + 2] ?? 0)];
  const [ax, ay, az] = [p[a] ?? 0, p[a + 1] ?? 0, p[a + 2] ?? 0];
  const [ux, uy, uz] = [(p[b] ?? 0) - ax, (p[b + 1] ?? 0) - ay, (p[b + 2] ?? 0) - az];
  const [vx, vy, vz] = [(p[c] ?? 0) - ax, (p[c + 1] ?? 0) - ay, (p[c + 2] ?? 0) - az];
  const [hx, hy, hz] = [d[1] * vz - d[2] * vy, d[2] * vx - d[0] * vz, d[0] * vy - d[1] * vx];
  const volume = ux * hx + uy * hy + uz * hz;
  if (volume === 0) return Infinity;
  const [sx, sy, sz] = [o[0] - ax, o[1] - ay, o[2] - az];
  const s = (sx * hx + sy * hy + sz * hz) / volume;
  if (s < 0 || s > 1) return Infinity;
  const [qx, qy, qz] = [sy * uz - sz * uy, sz * ux - sx * uz, sx * uy - sy * ux];
  const t = (d[0] * qx + d[1] * qy + d[2] * qz) / volume;
  if (t < 0 || s + t > 1) return Infinity;
  const distance = (vx * qx + vy * qy + vz * qz) / volume;
  return distance > 0 ? distance : Infinity;
}
