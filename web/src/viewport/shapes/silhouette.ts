// Which edges of a shape are on its silhouette, as seen from an eye.
import { EDGE } from "./edges";
import type { Point } from "./merged";

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

/** Numbers of one end of a stroke: the end, the other end, and on which side of the line this corner is. */
export const CORNER = 7;
const CORNERS = 4;

/** Writes four corners for each edge on the silhouettes; how many edges. */
export function writeSilhouettes(outlines: readonly Outline[], explode: number, eye: Eye, out: Float32Array): number {
  let count = 0;
  for (const { records, away } of outlines) {
    const off: Point = [explode * away[0], explode * away[1], explode * away[2]];
    for (let e = 0; e < records.length; e += EDGE) {
      if (isSilhouette(records, e, off, eye)) writeStroke(records, e, off, out, CORNERS * CORNER * count++);
    }
  }
  return count;
}

/** How many numbers the strokes of some outlines need at most. */
export const roomFor = (outlines: readonly Outline[]): number =>
  outlines.reduce((sum, { records }) => sum + (records.length / EDGE) * CORNERS * CORNER, 0);

/** One face looks at the eye, the other does not. */
function isSilhouette(r: Float32Array, e: number, off: Point, { at, parallel }: Eye): boolean {
  const x = parallel ? at[0] : at[0] - off[0] - (r[e] ?? 0);
  const y = parallel ? at[1] : at[1] - off[1] - (r[e + 1] ?? 0);
  const z = parallel ? at[2] : at[2] - off[2] - (r[e + 2] ?? 0);
  const left = (r[e + 6] ?? 0) * x + (r[e + 7] ?? 0) * y + (r[e + 8] ?? 0) * z;
  const right = (r[e + 9] ?? 0) * x + (r[e + 10] ?? 0) * y + (r[e + 11] ?? 0) * z;
  return left * right <= 0;
}

function writeStroke(r: Float32Array, e: number, off: Point, out: Float32Array, at: number): void {
  for (let corner = 0; corner < CORNERS; corner++) {
    const [own, other] = corner < 2 ? [e, e + 3] : [e + 3, e];
    const o = at + corner * CORNER;
    for (let axis = 0; axis < 3; axis++) {
      out[o + axis] = (r[own + axis] ?? 0) + (off[axis] ?? 0);
      out[o + 3 + axis] = (r[other + axis] ?? 0) + (off[axis] ?? 0);
    }
    out[o + 6] = corner === 0 || corner === 2 ? -1 : 1;
  }
}
