// The edges of a shape with the normals on both sides, and which of them are on its silhouette as seen from an eye.
import type { Shape } from "../../server/packet";
import { ORIGIN, plus, rangeOf } from "../../store/vectors";
import { faceNormals, type Point } from "./triangles";

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
  const welded = weldVertices(shape.positions);
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
  return packEdges([...sides.values()], shape.positions, normals);
}

function packEdges(sides: [number, number, number, number][], positions: Float32Array, normals: Float32Array): Edges {
  const isSharp = ([, , left, right]: [number, number, number, number]) =>
    right < 0 || dotAt(normals, 3 * left, 3 * right) < SHARP;
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
function weldVertices(positions: Float32Array): Uint32Array {
  const [low, high] = rangeOf(positions);
  const size = high > low ? high - low : 1;
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

const dotAt = (n: Float32Array, a: number, b: number): number =>
  (n[a] ?? 0) * (n[b] ?? 0) + (n[a + 1] ?? 0) * (n[b + 1] ?? 0) + (n[a + 2] ?? 0) * (n[b + 2] ?? 0);

/** Edges as `edgesOf` gives them, moved away by the exploded view; without normals they are always on it. */
export interface Outline {
  readonly records: Float32Array;
  readonly away: Point;
}

/** Where one looks from, in the frame of the shapes: a place, or for parallel projection a direction. */
export interface Eye {
  readonly at: Point;
  readonly parallel: boolean;
}

/** Numbers of one line: its two ends. */
export const LINE = 6;

/** Writes the two ends of each edge on the silhouettes; how many edges. */
export function writeSilhouettes(outlines: readonly Outline[], explode: number, eye: Eye, out: Float32Array): number {
  let count = 0;
  for (const { records, away } of outlines) {
    const off = plus(ORIGIN, away, explode);
    for (let e = 0; e < records.length; e += EDGE) {
      if (!isSilhouette(records, e, off, eye)) continue;
      for (let k = 0; k < LINE; k++) out[LINE * count + k] = (records[e + k] ?? 0) + (off[k % 3] ?? 0);
      count++;
    }
  }
  return count;
}

/** How many numbers the lines of some outlines need at most. */
export const roomFor = (outlines: readonly Outline[]): number => outlines.reduce((sum, { records }) => sum + (LINE / EDGE) * records.length, 0);

/** One face looks at the eye, the other does not. */
function isSilhouette(r: Float32Array, e: number, off: Point, { at, parallel }: Eye): boolean {
  const x = parallel ? at[0] : at[0] - off[0] - (r[e] ?? 0);
  const y = parallel ? at[1] : at[1] - off[1] - (r[e + 1] ?? 0);
  const z = parallel ? at[2] : at[2] - off[2] - (r[e + 2] ?? 0);
  const left = (r[e + 6] ?? 0) * x + (r[e + 7] ?? 0) * y + (r[e + 8] ?? 0) * z;
  const right = (r[e + 9] ?? 0) * x + (r[e + 10] ?? 0) * y + (r[e + 11] ?? 0) * z;
  return left * right <= 0;
}
