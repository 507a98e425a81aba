// Points and directions in space, without three.js.
export type Triple = [number, number, number];

export const minus = (a: Triple, b: Triple): Triple => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const negative = (a: Triple): Triple => [-a[0], -a[1], -a[2]];
export const dot = (a: Triple, b: Triple): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Triple, b: Triple): Triple => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

export type Axis = "x" | "y" | "z";

/** The choice of an axis that a plane lies across. */
export const ACROSS = (["x", "y", "z"] as const).map((value) => ({ value, label: value.toUpperCase(), name: `Across the ${value.toUpperCase()} axis` }));

/** An axis as rules name it, in the frame that is shown; yUp: whether its Y is shown as up, as `AssetView.y_up` says. */
export function axisShown(axis: Axis, yUp: boolean): Triple {
  if (axis === "x") return [1, 0, 0];
  if (!yUp) return axis === "y" ? [0, 1, 0] : [0, 0, 1];
  return axis === "y" ? [0, 0, 1] : [0, -1, 0];
}

/** From where to where points reach in a direction; all: x, y, z of each, array by array. */
export function spanAlong(all: readonly Float32Array[], across: Triple): [low: number, high: number] {
  let [low, high] = [Infinity, -Infinity];
  for (const positions of all) {
    for (let k = 0; k < positions.length; k += 3) {
      const at = dot([positions[k] ?? 0, positions[k + 1] ?? 0, positions[k + 2] ?? 0], across);
      [low, high] = [Math.min(low, at), Math.max(high, at)];
    }
  }
  return [low, high];
}
