// The edges of a shape with the normals on both sides, which tell where its silhouette is from any viewpoint.
import type { Shape } from "../../server/packet";

/** Numbers of one edge: its two ends, and the normals of the faces on its two sides. */
export const EDGE = 12;

export interface Edges {
  /** Twelve numbers an edge; sharp ones come first. */
  readonly records: Float32Array;
  readonly sharp: number;
}

const SHARP = Math.cos((14 * Math.PI) / 180);
const STEPS = 65535;

export function edgesOf(shape: Shape): Edges {
  const welded = weld(shape.positions);
  const normals = faceNormals(shape);
  const sides = new Map<number, [from: number, to: number, left: number, right: number]>();
  for (let k = 0; k < shape.index.length; k++) {
    const face = Math.floor(k / 3);
    const from = shape.index[k] ?? 0;
    const to = shape.index[k % 3 === 2 ? k - 2 : k + 1] ?? 0;
    const [a, b] = [welded[from] ?? 0, welded[to] ?? 0];
    if (a === b) continue;
    const key = Math.min(a, b) * welded.length + Math.max(a, b);
    const known = sides.get(key);
    if (known) known[3] = face;
    else sides.set(key, [from, to, face, -1]);
  }
  return written([...sides.values()], shape.positions, normals);
}

function written(sides: [number, number, number, number][], positions: Float32Array, normals: Float32Array): Edges {
  const isSharp = ([, , left, right]: [number, number, number, number]) =>
    right < 0 || dot(normals, 3 * left, 3 * right) < SHARP;
  const sharp = sides.filter(isSharp);
  const ordered = [...sharp, ...sides.filter((side) => !isSharp(side))];
  const records = new Float32Array(EDGE * ordered.length);
  ordered.forEach(([from, to, left, right], k) => {
    records.set(positions.subarray(3 * from, 3 * from + 3), EDGE * k);
    records.set(positions.subarray(3 * to, 3 * to + 3), EDGE * k + 3);
    records.set(normals.subarray(3 * left, 3 * left + 3), EDGE * k + 6);
    if (right >= 0) records.set(normals.subarray(3 * right, 3 * right + 3), EDGE * k + 9);
  });
  return { records, sharp: sharp.length };
}

/** For each vertex the first one in its place: rims of round primitives are there twice. */
function weld(positions: Float32Array): Uint32Array {
  const [low, size] = extent(positions);
  const first = new Map<number, number>();
  const out = new Uint32Array(positions.length / 3);
  for (let k = 0; k < out.length; k++) {
    let key = 0;
    for (let axis = 0; axis < 3; axis++) {
      key = key * (STEPS + 1) + Math.round((((positions[3 * k + axis] ?? 0) - low) / size) * STEPS);
    }
    const known = first.get(key);
    out[k] = known ?? k;
    if (known === undefined) first.set(key, k);
  }
  return out;
}

function extent(positions: Float32Array): [low: number, size: number] {
  let low = Infinity;
  let high = -Infinity;
  for (const at of positions) {
    if (at < low) low = at;
    if (at > high) high = at;
  }
  return [low, high > low ? high - low : 1];
}

/** The normal of each triangle. */
export function faceNormals({ positions: p, index }: Shape): Float32Array {
  const out = new Float32Array(index.length);
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [3 * (index[k] ?? 0), 3 * (index[k + 1] ?? 0), 3 * (index[k + 2] ?? 0)];
    const [ax, ay, az] = [p[a] ?? 0, p[a + 1] ?? 0, p[a + 2] ?? 0];
    const [ux, uy, uz] = [(p[b] ?? 0) - ax, (p[b + 1] ?? 0) - ay, (p[b + 2] ?? 0) - az];
    const [vx, vy, vz] = [(p[c] ?? 0) - ax, (p[c + 1] ?? 0) - ay, (p[c + 2] ?? 0) - az];
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const length = Math.hypot(x, y, z) || 1;
    out[k] = x / length;
    out[k + 1] = y / length;
    out[k + 2] = z / length;
  }
  return out;
}

const dot = (n: Float32Array, a: number, b: number): number =>
  (n[a] ?? 0) * (n[b] ?? 0) + (n[a + 1] ?? 0) * (n[b + 1] ?? 0) + (n[a + 2] ?? 0) * (n[b + 2] ?? 0);
