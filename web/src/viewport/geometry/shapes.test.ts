
import { expect, test } from "vitest";
import { niceStep } from "../drawing/ground";
import type { Shape } from "../../server/packet";
import { EDGE, edgesOf, roomFor, writeSilhouettes } from "./edges";
import { boxAround, facetsOf, mergeShapes, middleOf } from "./triangles";

/** A unit cube with shared corners, two triangles a side. */
const cube: Shape = {
  positions: new Float32Array([0,0,0, 1,0,0, 1,1,0, 0,1,0, 0,0,1, 1,0,1, 1,1,1, 0,1,1]),
  index: new Uint32Array([0,2,1, 0,3,2, 4,5,6, 4,6,7, 0,1,5, 0,5,4, 2,3,7, 2,7,6, 1,2,6, 1,6,5, 0,4,7, 0,7,3]),
};
/** The same with corners of its own for every triangle. */
const loose: Shape = {
  positions: new Float32Array([...cube.index].flatMap((k) => [...cube.positions.subarray(3 * k, 3 * k + 3)])),
  index: new Uint32Array(cube.index.map((_, k) => k)),
};

test("a cube has twelve sharp edges, and its diagonals are not", () => {
  const { records, sharp } = edgesOf(cube);
  expect([sharp, records.length / EDGE]).toEqual([12, 18]);
});

test("corners in one place are one corner", () => {
  expect(edgesOf(loose).sharp).toBe(12);
});

test("the silhouette of a cube has four edges from one side and six from a corner", () => {
  const outline = [{ records: edgesOf(cube).records, away: [0, 0, 0] as const }];
  const out = new Float32Array(roomFor(outline));
  const count = (at: readonly [number, number, number]) => writeSilhouettes(outline, 0, { at, parallel: true }, out);
  expect(count([1, 2, 3])).toBe(6);
  expect(writeSilhouettes(outline, 0, { at: [0.5, 0.4, 9], parallel: false }, out)).toBe(4);
});

test("each facet has a last corner of its own, with the normal of the facet", () => {
  const { positions, normals, index } = facetsOf(cube);
  const lasts = new Set<number>();
  for (let k = 0; k < index.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((j) => (index[k + j] ?? 0) * 3) as [number, number, number];
    const edge = (from: number, to: number) => [0, 1, 2].map((j) => (positions[to + j] ?? 0) - (positions[from + j] ?? 0)) as [number, number, number];
    const [u, v] = [edge(a, b), edge(a, c)];
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    expect([...normals.subarray(c, c + 3)].map((value) => value + 0)).toEqual(n.map((value) => value + 0));
    lasts.add(c);
  }
  expect(lasts.size).toBe(12);
});

test("merged triangles count from the first vertex of their shape", () => {
  const both = mergeShapes([cube, loose]);
  expect([both.count, [...both.faces]]).toEqual([2, [0, 12, 24]]);
  expect(Math.min(...both.index.subarray(36))).toBe(8);
  expect(middleOf(both.boxes, 1)).toEqual([0.5, 0.5, 0.5]);
  expect(boxAround(both.boxes, [])).toBeNull();
});

test("steps of the grid are 1, 2 or 5 times a power of ten", () => {
  expect([0.013, 0.2, 0.74, 7].map(niceStep)).toEqual([0.01, 0.2, 0.5, 5]);
});
