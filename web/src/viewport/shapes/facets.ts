// Flat faces with few vertices: the last corner of each triangle is its own, and tells the face's normal.
import type { Shape } from "../../server/packet";
import { faceNormals } from "./edges";

/** x, y, z and normal of each vertex; a normal counts only for the triangle that the vertex is the last corner of. */
export interface Facets {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly index: Uint32Array;
}

export function facetsOf(shape: Shape): Facets {
  const count = shape.positions.length / 3;
  const faces = faceNormals(shape);
  const index = new Uint32Array(shape.index.length);
  const source: number[] = Array.from({ length: count }, (_, k) => k);
  const owner = new Int32Array(count + shape.index.length / 3).fill(-1);
  for (let corner = 0; corner < index.length; corner += 3) {
    const abc = [0, 1, 2].map((k) => shape.index[corner + k] ?? 0) as [number, number, number];
    const free = abc.findIndex((vertex) => owner[vertex] === -1);
    const last = free >= 0 ? free : 2;
    const own = free >= 0 ? abc[last] : source.push(abc[last] ?? 0) - 1;
    owner[own ?? 0] = corner / 3;
    index.set([abc[(last + 1) % 3] ?? 0, abc[(last + 2) % 3] ?? 0, own ?? 0], corner);
  }
  const positions = new Float32Array(3 * source.length);
  const normals = new Float32Array(3 * source.length);
  source.forEach((vertex, k) => {
    positions.set(shape.positions.subarray(3 * vertex, 3 * vertex + 3), 3 * k);
    const face = owner[k] ?? -1;
    if (face >= 0) normals.set(faces.subarray(3 * face, 3 * face + 3), 3 * k);
  });
  return { positions, normals, index };
}
