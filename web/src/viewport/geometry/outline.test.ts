// Laws of outlines and of regions that meet them.
import { describe, expect, it } from "vitest";
import { meets, outlineOf } from "./outline";
import { boxRegion, isInside, type Spot } from "./region";

/** Spots that look random, the same each time. */
function spots(seed: number, count: number, size = 100): Spot[] {
  let state = seed;
  const next = (): number => (state = (state * 16807) % 2147483647) / 2147483647;
  return Array.from({ length: count }, () => [size * next(), size * next()] as const);
}

describe("the outline of spots", () => {
  it("has them all inside or on it, and is its own outline", () => {
    for (let seed = 1; seed < 40; seed++) {
      const all = spots(seed, 20);
      const outline = outlineOf(all);
      const middle: Spot = [0, 1].map((axis) => outline.reduce((sum, spot) => sum + (spot[axis] ?? 0), 0) / outline.length) as never;
      for (const [x, y] of all) {
        expect(isInside(outline, [middle[0] + 0.999 * (x - middle[0]), middle[1] + 0.999 * (y - middle[1])])).toBe(true);
      }
      expect(outlineOf(outline)).toEqual(outline);
    }
  });

  it("of one spot, or of two, is these", () => {
    expect(outlineOf([[1, 2]])).toEqual([[1, 2]]);
    expect(outlineOf([[3, 2], [1, 2]])).toEqual([[1, 2], [3, 2]]);
  });
});

describe("a region meets an outline", () => {
  const outline = outlineOf([[10, 10], [20, 10], [20, 20], [10, 20]]);

  it("that is inside it, around it, or crosses it", () => {
    expect(meets(boxRegion([0, 0], [30, 30]), outline)).toBe(true);
    expect(meets(boxRegion([12, 12], [14, 14]), outline)).toBe(true);
    expect(meets(boxRegion([0, 12], [30, 14]), outline)).toBe(true);
    expect(meets(boxRegion([15, 15], [40, 40]), outline)).toBe(true);
  });

  it("and none beside it, though their boxes meet", () => {
    expect(meets(boxRegion([21, 0], [30, 30]), outline)).toBe(false);
    expect(meets([[0, 28], [0, 40], [40, 40], [40, 0], [28, 0], [28, 28]], outline)).toBe(false);
  });

  it("wherever some spot lies in both, in any order of the corners", () => {
    for (let seed = 1; seed < 60; seed++) {
      const some = outlineOf(spots(seed, 6));
      const region = outlineOf(spots(seed + 100, 6));
      const both = spots(seed + 200, 400).some((spot) => isInside(some, spot) && isInside(region, spot));
      if (both) expect([meets(region, some), meets([...region].reverse(), some), meets(some, region)]).toEqual([true, true, true]);
    }
  });
});
