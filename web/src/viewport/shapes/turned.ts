// Boxes and points of the file's frame, turned into the canonical frame.
import { Matrix4, Vector3 } from "three";
import { cornersOf } from "../camera/pose";

/** The matrix of 16 numbers row by row; the identity for none. */
export function matrixOf(rows: readonly number[] | null): Matrix4 {
  return rows ? new Matrix4().fromArray([...rows]).transpose() : new Matrix4();
}

/** The box around a box after turning it. */
export function turnedBox(box: readonly number[], upright: readonly number[] | null): number[] {
  const matrix = matrixOf(upright);
  const corners = cornersOf(box).map((corner) => new Vector3(...corner).applyMatrix4(matrix).toArray());
  const along = (axis: number) => corners.map((corner) => corner[axis] ?? 0);
  return [0, 1, 2].map((axis) => Math.min(...along(axis))).concat([0, 1, 2].map((axis) => Math.max(...along(axis))));
}
