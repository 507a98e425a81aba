// Points and directions in space, without three.js.
export type Triple = [number, number, number];
export type Vec = Readonly<Triple>;

export const ORIGIN: Vec = [0, 0, 0];

export const plus = (a: Vec, b: Vec, times = 1): Triple => [a[0] + b[0] * times, a[1] + b[1] * times, a[2] + b[2] * times];
export const minus = (a: Vec, b: Vec): Triple => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const midpoint = (a: Vec, b: Vec): Triple => plus(a, minus(b, a), 0.5);
export const negative = (a: Vec): Triple => [-a[0], -a[1], -a[2]];
export const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Vec, b: Vec): Triple => [
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

/** The lowest and the highest of some numbers. */
export function rangeOf(values: Iterable<number>): [low: number, high: number] {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return [low, high];
}
