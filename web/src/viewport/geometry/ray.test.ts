
import { expect, test } from "vitest";
import type { Shape } from "../../server/packet";
import { castRay } from "./ray";
import { mergeShapes } from "./triangles";

/** A tetrahedron with its right angle at a point. */
function corner(x: number, y: number, z: number, size = 1): Shape {
  const positions = new Float32Array([x, y, z, x + size, y, z, x, y + size, z, x, y, z + size]);
  return { positions, index: new Uint32Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]) };
}
const shapes = mergeShapes([corner(0, 0, 0), corner(0, 0, 5)]);
const seen = [true, true];
const none = [0, 0, 0] as const;
const down = { from: [0.2, 0.2, 10], along: [0, 0, -1] } as const;

test("the nearest shape on the ray is met", () => {
  expect(castRay(shapes, down, seen, [none, none], 0)?.place).toBe(1);
});

test("a ray goes through what is hidden", () => {
  expect(castRay(shapes, down, [true, false], [none, none], 0)?.place).toBe(0);
});

test("a ray beside all shapes meets none, also where it crosses a box", () => {
  expect(castRay(shapes, { from: [0.9, 0.9, 10], along: [0, 0, -1] }, seen, [none, none], 0)).toBeNull();
});

test("shapes behind the eye are not met", () => {
  expect(castRay(shapes, { from: [0.2, 0.2, 10], along: [0, 0, 1] }, seen, [none, none], 0)).toBeNull();
});

test("in the exploded view shapes are met where they are shown", () => {
  const aways = [none, [3, 0, 0]] as const;
  expect(castRay(shapes, down, seen, aways, 1)?.place).toBe(0);
  expect(castRay(shapes, { from: [3.2, 0.2, 10], along: [0, 0, -1] }, seen, aways, 1)?.place).toBe(1);
});
