// Distances between convex shapes against those that are known.
import { describe, expect, it } from "vitest";
import { nearestPoints } from "./nearest";

const box = (low: readonly number[], size: readonly number[]): Float32Array =>
  new Float32Array([0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [k & 1, (k >> 1) & 1, (k >> 2) & 1].map((c, axis) => (low[axis] ?? 0) + c * (size[axis] ?? 0))));

/** Distance of boxes along the axes. */
const boxDistance = (a: [number[], number[]], b: [number[], number[]]): number =>
  Math.hypot(
    ...[0, 1, 2].map((k) => {
      const [al, as, bl, bs] = [a[0][k] ?? 0, a[1][k] ?? 0, b[0][k] ?? 0, b[1][k] ?? 0];
      return Math.max(0, bl - (al + as), al - (bl + bs));
    }),
  );

let seed = 7;
const random = (): number => (seed = (16807 * seed) % 2147483647) / 2147483647;
const triple = (scale: number, from = 0): number[] => [0, 1, 2].map(() => from + scale * random());

describe("the gap between two hulls", () => {
  it.each(Array.from({ length: 60 }, (_, k) => k))("is that of boxes, the same both ways, between points of both: %i", () => {
    const [a, b] = [[triple(3), triple(1, 0.1)], [triple(3), triple(1, 0.1)]] as [[number[], number[]], [number[], number[]]];
    const wanted = boxDistance(a, b);
    const found = nearestPoints(box(...a), box(...b));
    expect(found.distance).toBeCloseTo(wanted, 5);
    expect(nearestPoints(box(...b), box(...a)).distance).toBeCloseTo(wanted, 5);
    if (wanted > 0) expect(Math.hypot(...found.a.map((value, k) => value - (found.b[k] ?? 0)))).toBeCloseTo(wanted, 5);
  });

  it("is nought where they touch, and where they cross without a corner of one in the other", () => {
    expect(nearestPoints(box([0, 0, 0], [1, 1, 1]), box([1, 0.2, 0.2], [1, 1, 1])).distance).toBe(0);
    expect(nearestPoints(box([-2, 0, 0], [5, 1, 1]), box([0.2, -2, 0.2], [0.5, 5, 0.5])).distance).toBe(0);
  });

  it("is that of two edges that pass each other", () => {
    const along = new Float32Array([-1, 0, 0, 1, 0, 0, 0, 0, -1, 0, -0.1, -1]);
    const across = new Float32Array([0, -1, 0.3, 0, 1, 0.3, 0, 0, 1, 0.1, 0, 1]);
    expect(nearestPoints(along, across).distance).toBeCloseTo(0.3, 5);
  });

  it("of a shape far from the origin is as exact", () => {
    const found = nearestPoints(box([100, 0, 0], [1, 1, 1]), box([101.25, 0.5, 0.5], [1, 1, 1]));
    expect(found.distance).toBeCloseTo(0.25, 4);
  });
});
