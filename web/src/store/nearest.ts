// How far two convex shapes are apart, and where: the distance algorithm of Gilbert, Johnson and Keerthi (1988).
import { cross, dot, minus, negative, ORIGIN, type Triple, type Vec } from "./vectors";

/** Of two shapes: the points that are nearest to each other, and how far these are apart [m]; 0 where they touch. */
interface Nearest {
  readonly distance: number;
  readonly a: Triple;
  readonly b: Triple;
}

/** A corner of the difference of both shapes, with the corners that it is the difference of. */
interface Corner {
  readonly at: Triple;
  readonly a: Vec;
  readonly b: Vec;
}

/** A point of a simplex as a weighted mean of its corners. */
interface Mean {
  readonly at: Triple;
  readonly corners: readonly Corner[];
  readonly weights: readonly number[];
}

const ROUNDS = 100;
const EXACT = 1e-6; // of the size of the shapes: less than their numbers can tell

/** positions: x, y, z of the corners of each shape [m]. */
export function nearestPoints(positionsA: Float32Array, positionsB: Float32Array): Nearest {
  const [a, b] = [pointsOf(positionsA), pointsOf(positionsB)];
  const size = Math.max(...[...a, ...b].map((point) => Math.hypot(...point)), 1e-12);
  const support = (way: Triple): Corner => differenceOf(farthest(a, way), farthest(b, negative(way)));
  let best = meanOf([support([1, 0, 0])], [1]);
  for (let round = 0; round < ROUNDS; round++) {
    const squared = dot(best.at, best.at);
    if (squared <= (EXACT * size) ** 2) break;
    const next = support(negative(best.at));
    const isKnown = best.corners.some((corner) => corner.at.every((value, k) => value === next.at[k]));
    if (isKnown || squared - dot(best.at, next.at) <= 1e-12 * squared) break;
    const nearer = nearestIn([...best.corners, next]);
    if (!nearer) return { distance: 0, ...witnesses(best) };
    if (dot(nearer.at, nearer.at) >= squared) break;
    best = nearer;
  }
  const distance = Math.hypot(...best.at);
  return { distance: distance <= EXACT * size ? 0 : distance, ...witnesses(best) };
}

const pointsOf = (positions: Float32Array): Triple[] =>
  Array.from({ length: positions.length / 3 }, (_, k) => [...positions.subarray(3 * k, 3 * k + 3)] as Triple);

const differenceOf = (a: Vec, b: Vec): Corner => ({ at: minus(a, b), a, b });

function farthest(points: readonly Triple[], way: Triple): Vec {
  let [best, most] = [points[0] ?? ORIGIN, -Infinity];
  for (const point of points) {
    const along = dot(point, way);
    if (along > most) [best, most] = [point, along];
  }
  return best;
}

/** The point of a simplex that is nearest to the origin; null where the origin is within a tetrahedron. */
function nearestIn(corners: readonly Corner[]): Mean | null {
  const [a, b, c, d] = corners;
  if (!a || !b || !c || !d) return nearestOnFace(corners);
  if (isWithin([a, b, c, d])) return null;
  return nearestOf([[a, b, c], [a, b, d], [a, c, d], [b, c, d]].map(nearestOnFace));
}

/** Whether the origin is on the inner side of all four faces; never in a flat tetrahedron. */
function isWithin(corners: readonly Corner[]): boolean {
  const all = corners.map((corner) => corner.at);
  return all.every((apex, k) => {
    const [p, q, r] = all.filter((_, other) => other !== k) as [Triple, Triple, Triple];
    const normal = cross(minus(q, p), minus(r, p));
    return dot(normal, minus(apex, p)) * dot(normal, negative(p)) > 0;
  });
}

/** Of a point, a line or a triangle. */
function nearestOnFace(corners: readonly Corner[]): Mean {
  const [a, b, c] = corners;
  if (!a || !b) return meanOf(corners, [1]);
  if (!c) return nearestOnLine(a, b);
  const inside = nearestInside(a, b, c);
  return nearestOf([nearestOnLine(a, b), nearestOnLine(a, c), nearestOnLine(b, c), ...(inside ? [inside] : [])]);
}

function nearestOnLine(a: Corner, b: Corner): Mean {
  const along = minus(b.at, a.at);
  const share = -dot(a.at, along) / (dot(along, along) || 1);
  if (share <= 0) return meanOf([a], [1]);
  return share >= 1 ? meanOf([b], [1]) : meanOf([a, b], [1 - share, share]);
}

/** Straight above the origin in a triangle; null where that is outside of it. */
function nearestInside(a: Corner, b: Corner, c: Corner): Mean | null {
  const [u, v, w] = [minus(b.at, a.at), minus(c.at, a.at), negative(a.at)];
  const normal = cross(u, v);
  const squared = dot(normal, normal);
  const ofC = dot(cross(u, w), normal) / squared;
  const ofB = dot(cross(w, v), normal) / squared;
  const weights = [1 - ofB - ofC, ofB, ofC];
  return weights.every((weight) => weight > 0) ? meanOf([a, b, c], weights) : null;
}

const nearestOf = (means: readonly Mean[]): Mean =>
  means.reduce((best, mean) => (dot(mean.at, mean.at) < dot(best.at, best.at) ? mean : best));

function meanOf(corners: readonly Corner[], weights: readonly number[]): Mean {
  return { at: weighted(corners.map((corner) => corner.at), weights), corners, weights };
}

function weighted(points: readonly Vec[], weights: readonly number[]): Triple {
  const along = (axis: number) => points.reduce((sum, point, k) => sum + (weights[k] ?? 0) * (point[axis] ?? 0), 0);
  return [along(0), along(1), along(2)];
}

const witnesses = ({ corners, weights }: Mean): { a: Triple; b: Triple } => ({
  a: weighted(corners.map((corner) => corner.a), weights),
  b: weighted(corners.map((corner) => corner.b), weights),
});
