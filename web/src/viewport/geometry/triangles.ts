// The triangles of many shapes in one buffer, with flat faces of few vertices, and the boxes around shapes.
import { Box3, Matrix4, Triangle, Vector3 } from "three";
import type { Shape } from "../../server/packet";
import { layersOf } from "./layers";

export interface MergedShapes {
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
  /** Which of two shapes is in front where they share a face: the one in the lower layer. */
  readonly layers: Float32Array;
}

export function mergeShapes(shapes: readonly Shape[]): MergedShapes {
  const boxes = new Float32Array(shapes.flatMap(({ positions }) => boxOf(positions)));
  return { ...joinShapes(shapes), boxes, layers: layersOf(boxes) };
}

/** The triangles of shapes one after the other. */
export function joinShapes(shapes: readonly Shape[]): Omit<MergedShapes, "boxes" | "layers"> {
  const vertices = shapes.reduce((sum, shape) => sum + shape.positions.length / 3, 0);
  const corners = shapes.reduce((sum, shape) => sum + shape.index.length, 0);
  const out = {
    count: shapes.length,
    positions: new Float32Array(3 * vertices),
    owner: new Float32Array(vertices),
    index: new Uint32Array(corners),
    faces: new Uint32Array(shapes.length + 1),
  };
  let vertex = 0;
  let corner = 0;
  shapes.forEach((shape, k) => {
    const many = shape.positions.length / 3;
    out.positions.set(shape.positions, 3 * vertex);
    out.owner.fill(k, vertex, vertex + many);
    for (const place of shape.index) out.index[corner++] = place + vertex;
    out.faces[k + 1] = corner / 3;
    vertex += many;
  });
  return out;
}

/** The lowest and the highest corner of some points. */
export const boxOf = (positions: Float32Array): number[] => cornersOf(new Box3().setFromArray(positions));

const cornersOf = ({ min, max }: Box3): number[] => [...min, ...max];

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

/** x, y, z and normal of each vertex; a normal counts only for the triangle that the vertex is the last corner of. */
export interface Facets {
  readonly positions: Float32Array;
  readonly normals: Float32Array;
  readonly index: Uint32Array;
}

/** Flat faces with few vertices: the last corner of each triangle is its own, and tells the face's normal. */
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

/** The matrix of 16 numbers row by row; the identity for none. */
export function matrixOf(rows: readonly number[] | null): Matrix4 {
  return rows ? new Matrix4().fromArray([...rows]).transpose() : new Matrix4();
}

/** The box around a box after turning it. */
export const rotateBox = (box: readonly number[], upright: readonly number[] | null): number[] =>
  cornersOf(new Box3().setFromArray(box).applyMatrix4(matrixOf(upright)));

const one = new Triangle();

/** A triangle by its number, until the next one is asked for. */
export function triangleAt(positions: Float32Array, index: Uint32Array, face: number): Triangle {
  one.a.fromArray(positions, 3 * (index[3 * face] ?? 0));
  one.b.fromArray(positions, 3 * (index[3 * face + 1] ?? 0));
  one.c.fromArray(positions, 3 * (index[3 * face + 2] ?? 0));
  return one;
}

/** The normal of each triangle. */
export function faceNormals({ positions, index }: Shape): Float32Array {
  const out = new Float32Array(index.length);
  const normal = new Vector3();
  for (let face = 0; 3 * face < index.length; face++) triangleAt(positions, index, face).getNormal(normal).toArray(out, 3 * face);
  return out;
}
