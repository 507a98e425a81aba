// The triangles of many shapes in one buffer, so that a whole asset is drawn in one call.
import type { Shape } from "../../server/packet";

export interface Merged {
  readonly count: number;
  /** x, y, z of every vertex [m]. */
  readonly positions: Float32Array;
  /** The place of the shape that each vertex belongs to. */
  readonly owner: Float32Array;
  readonly index: Uint32Array;
  /** Where the triangles of each shape begin, and where the last ones end. */
  readonly faces: Uint32Array;
  /** The lowest and the highest corner of each shape, six numbers. */
  readonly boxes: Float32Array;
}

export function merged(shapes: readonly Shape[]): Merged {
  const vertices = shapes.reduce((sum, shape) => sum + shape.positions.length / 3, 0);
  const corners = shapes.reduce((sum, shape) => sum + shape.index.length, 0);
  const out = {
    count: shapes.length,
    positions: new Float32Array(3 * vertices),
    owner: new Float32Array(vertices),
    index: new Uint32Array(corners),
    faces: new Uint32Array(shapes.length + 1),
    boxes: new Float32Array(6 * shapes.length),
  };
  let vertex = 0;
  let corner = 0;
  shapes.forEach((shape, k) => {
    const many = shape.positions.length / 3;
    out.positions.set(shape.positions, 3 * vertex);
    out.owner.fill(k, vertex, vertex + many);
    for (const place of shape.index) out.index[corner++] = place + vertex;
    out.faces[k + 1] = corner / 3;
    out.boxes.set(boxOf(shape.positions), 6 * k);
    vertex += many;
  });
  return out;
}

/** The lowest and the highest corner of some points. */
export function boxOf(positions: Float32Array): readonly number[] {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let k = 0; k < positions.length; k++) {
    const at = positions[k] ?? 0;
    const axis = k % 3;
    if (at < (box[axis] ?? 0)) box[axis] = at;
    if (at > (box[axis + 3] ?? 0)) box[axis + 3] = at;
  }
  return box;
}

export type Point = readonly [number, number, number];

/** The middle of a shape's box. */
export function middleOf(boxes: Float32Array, k: number): Point {
  const mid = (axis: number) => ((boxes[6 * k + axis] ?? 0) + (boxes[6 * k + axis + 3] ?? 0)) / 2;
  return [mid(0), mid(1), mid(2)];
}

/** The box around some of the shapes' boxes; null around none. */
export function boxAround(boxes: Float32Array, places: Iterable<number>): readonly number[] | null {
  const corners: number[] = [];
  for (const k of places) corners.push(...boxes.subarray(6 * k, 6 * k + 6));
  return corners.length ? boxOf(new Float32Array(corners)) : null;
}
