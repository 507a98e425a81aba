import { describe, expect, it } from "vitest";
import { castRay } from "./ray";
import { boxOf, mergeShapes, type Point } from "./triangles";
import { layersOf } from "./layers";
import { box } from "../stage/boxes.test-help";

/** Numbers in [0, 1), the same each time. */
function generator(seed: number): () => number {
  let state = seed;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
}

const boxesOf = (shapes: readonly { positions: Float32Array }[]) => new Float32Array(shapes.flatMap(({ positions }) => boxOf(positions)));

describe.each([1, 2, 3, 4, 5])("drawn by seed %i", (seed) => {
  const random = generator(seed);
  const whole = (span: number) => Math.floor(span * random());
  // on a grid, so that many share planes
  const shapes = Array.from({ length: 60 }, () => box("", [whole(8), whole(8), whole(4)], [1 + whole(2), 1 + whole(2), 1]).shape);
  const boxes = boxesOf(shapes);
  const layers = layersOf(boxes);
  const at = (k: number, side: number) => boxes[6 * k + side] ?? 0;

  it("no two shapes whose boxes touch are in one layer", () => {
    for (let a = 0; a < shapes.length; a++) {
      for (let b = 0; b < a; b++) {
        const touch = [0, 1, 2].every((axis) => at(a, axis) <= at(b, axis + 3) && at(b, axis) <= at(a, axis + 3));
        if (touch) expect(layers[a]).not.toBe(layers[b]);
      }
    }
  });

  it("a ray meets the same one of two shapes with faces in one plane from every side, in the lower layer", () => {
    const merged = mergeShapes(shapes);
    const still = shapes.map((): Point => [0, 0, 0]);
    const all = shapes.map(() => true);
    for (let k = 0; k < 40; k++) {
      const spot: Point = [8 * random(), 8 * random(), 4.01];
      const met = [[0, 0, 9], [3, -2, 5], [-4, 6, 30]].map((from) => {
        const along: Point = [spot[0] - (from[0] ?? 0), spot[1] - (from[1] ?? 0), 4 - (from[2] ?? 0)];
        const seen = castRay(merged, { from: from as never, along }, all, still, 0);
        return seen && Math.abs(seen.distance - 1) < 1e-4 ? seen.place : null;
      });
      const tops = shapes.flatMap((_, j) => (at(j, 5) === 4 && at(j, 0) < spot[0] && spot[0] < at(j, 3) && at(j, 1) < spot[1] && spot[1] < at(j, 4) ? [j] : []));
      const first = tops.sort((a, b) => (layers[a] ?? 0) - (layers[b] ?? 0))[0] ?? null;
      for (const place of met) expect(place).toBe(first);
    }
  });
});

it("there are few layers where shapes are apart", () => {
  expect(new Set(layersOf(boxesOf([0, 3, 6, 9].map((x) => box("", [x, 0, 0]).shape))))).toEqual(new Set([0]));
  expect([...layersOf(new Float32Array(0))]).toEqual([]);
});
