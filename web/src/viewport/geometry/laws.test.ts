// Laws of rays, silhouettes, regions and boxes, on shapes and views drawn by a fixed generator.
import { describe, expect, it } from "vitest";
import type { Shape } from "../../server/packet";
import { EDGE, edgesOf, roomFor, writeSilhouettes } from "./edges";
import { castRay } from "./ray";
import { boxRegion, isInside, placesInside, type Region, type Spot } from "./region";
import { boxAround, boxOf, faceNormals, facetsOf, matrixOf, mergeShapes, middleOf, type Point, rotateBox } from "./triangles";

/** The same numbers in [0, 1) each time (mulberry32). */
function generator(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, (k >> 2) & 1] as const);
const FACES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];

function boxShape(low: Point, size: Point): Shape {
  const positions = CORNERS.flatMap((corner) => corner.map((c, axis) => (low[axis] ?? 0) + c * (size[axis] ?? 0)));
  return { positions: new Float32Array(positions), index: new Uint32Array(FACES) };
}

function randomBoxes(random: () => number, count: number): Shape[] {
  const point = (least: number, span: number): Point => [least + span * random(), least + span * random(), least + span * random()];
  return Array.from({ length: count }, () => boxShape(point(-5, 10), point(0.1, 2)));
}

/** How far along a ray a box is met by its three slabs; null where it is not. */
function slabDistance(box: readonly number[], from: Point, along: Point): number | null {
  let [near, far] = [-Infinity, Infinity];
  for (const axis of [0, 1, 2] as const) {
    const [a, b] = [((box[axis] ?? 0) - from[axis]) / along[axis], ((box[axis + 3] ?? 0) - from[axis]) / along[axis]];
    near = Math.max(near, Math.min(a, b));
    far = Math.min(far, Math.max(a, b));
  }
  if (near > far || far <= 0) return null;
  return near > 0 ? near : far;
}

const seeds = Array.from({ length: 20 }, (_, k) => k + 1);

describe.each(seeds)("drawn by seed %i", (seed) => {
  const random = generator(seed);
  const shapes = randomBoxes(random, 12);
  const merged = mergeShapes(shapes);
  const boxes = shapes.map(({ positions }) => boxOf(positions));
  const all = shapes.map(() => true);
  const still = shapes.map((): Point => [0, 0, 0]);

  it("a ray meets the box that its slabs say is nearest", () => {
    for (let k = 0; k < 20; k++) {
      const from: Point = [20 * random() - 10, 20 * random() - 10, 20 * random() - 10];
      const along: Point = [random() - 0.5, random() - 0.5, random() - 0.5];
      const distances = boxes.map((box) => slabDistance(box, from, along) ?? Infinity);
      const nearest = Math.min(...distances);
      const met = castRay(merged, { from, along }, all, still, 0);
      if (nearest === Infinity) expect(met).toBeNull();
      else expect(met?.distance).toBeCloseTo(nearest, 3);
    }
  });

  it("a ray meets the same hull where both are moved together", () => {
    const aways = shapes.map((): Point => [random(), random(), random()]);
    const from: Point = [0, 0, 20];
    for (let k = 0; k < shapes.length; k++) {
      const at = middleOf(merged.boxes, k);
      const along: Point = [at[0] - from[0], at[1] - from[1], at[2] - from[2]];
      const only = shapes.map((_, j) => j === k);
      const moved: Point = [from[0] + 2 * (aways[k]?.[0] ?? 0), from[1] + 2 * (aways[k]?.[1] ?? 0), from[2] + 2 * (aways[k]?.[2] ?? 0)];
      const before = castRay(merged, { from, along }, only, still, 0);
      const after = castRay(merged, { from: moved, along }, only, aways, 2);
      expect(after?.place).toBe(k);
      expect(after?.distance).toBeCloseTo(before?.distance ?? NaN, 4);
    }
  });

  it("the box around shapes holds all their vertices, and is no larger", () => {
    const places = shapes.flatMap((_, k) => (random() < 0.5 ? [k] : []));
    const around = boxAround(merged.boxes, places);
    if (!places.length) return expect(around).toBeNull();
    const points = places.flatMap((k) => [...(shapes[k]?.positions ?? [])]);
    for (const axis of [0, 1, 2]) {
      const values = points.filter((_, k) => k % 3 === axis);
      expect(around?.[axis]).toBe(Math.min(...values));
      expect(around?.[axis + 3]).toBe(Math.max(...values));
    }
  });

  it("a quarter turn of a box four times is the box", () => {
    const quarter = [0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    const box = [...(boxes[0] ?? [])];
    const turned = [1, 2, 3, 4].reduce((now) => rotateBox(now, quarter), box);
    turned.forEach((value, k) => expect(value).toBeCloseTo(box[k] ?? NaN, 6));
    expect(rotateBox(box, null)).toEqual(box);
  });

  it("the silhouette of a box has as many edges from a side as from the other", () => {
    const outline = shapes.slice(0, 3).map((shape) => ({ records: edgesOf(shape).records, away: [0, 0, 0] as Point }));
    const out = new Float32Array(roomFor(outline));
    const at: Point = [random() - 0.5, random() - 0.5, random() - 0.5];
    const back: Point = [-at[0], -at[1], -at[2]];
    const count = writeSilhouettes(outline, 0, { at, parallel: true }, out);
    expect(count).toBe(3 * 6);
    expect(writeSilhouettes(outline, 0, { at: back, parallel: true }, out)).toBe(count);
  });

  it("normals have length one, and point out of a box", () => {
    const shape = shapes[0] as Shape;
    const normals = faceNormals(shape);
    const middle = middleOf(merged.boxes, 0);
    for (let k = 0; k < shape.index.length; k += 3) {
      const n = [...normals.subarray(k, k + 3)];
      expect(Math.hypot(...n)).toBeCloseTo(1, 5);
      const corner = 3 * (shape.index[k] ?? 0);
      const out = n.reduce((sum, value, axis) => sum + value * ((shape.positions[corner + axis] ?? 0) - (middle[axis] ?? 0)), 0);
      expect(out).toBeGreaterThan(0);
    }
  });

  it("facets are the same triangles", () => {
    const shape = shapes[1] as Shape;
    const { positions, index } = facetsOf(shape);
    const corners = (of: { positions: Float32Array; index: Uint32Array }, k: number) =>
      [0, 1, 2].map((c) => [...of.positions.subarray(3 * (of.index[k + c] ?? 0), 3 * (of.index[k + c] ?? 0) + 3)].join()).sort();
    for (let k = 0; k < index.length; k += 3) expect(corners({ positions, index }, k)).toEqual(corners(shape, k));
  });

  it("a region has inside what its rows of pixels have", () => {
    const region: Region = Array.from({ length: 5 }, (): Spot => [30 * random(), 30 * random()]);
    const [width, height] = [30, 30];
    const places = Uint32Array.from({ length: width * height }, (_, k) => k + 1);
    const found = placesInside(region, places, width, height);
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const isIn = isInside(region, [x + 0.5, y + 0.5]);
        if (isIn) expect(found.has(y * width + x)).toBe(true);
      }
    }
  });
});

it("merging keeps each shape's triangles and its own place", () => {
  const shapes = randomBoxes(generator(7), 3);
  const { owner, faces, index, positions, count } = mergeShapes(shapes);
  expect([count, [...faces]]).toEqual([3, [0, 12, 24, 36]]);
  expect([...owner]).toEqual(Array.from({ length: 24 }, (_, k) => Math.floor(k / 8)));
  expect([...index.subarray(36, 39)]).toEqual(FACES.slice(0, 3).map((k) => k + 8));
  expect([...positions.subarray(24, 48)]).toEqual([...(shapes[1]?.positions ?? [])]);
});

it("nothing is merged to nothing, and around nothing is no box", () => {
  const { count, positions, index, boxes } = mergeShapes([]);
  expect([count, positions.length, index.length]).toEqual([0, 0, 0]);
  expect(boxAround(boxes, [])).toBeNull();
});

it("an open surface is on its silhouette all along its rim", () => {
  const triangle: Shape = { positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]), index: new Uint32Array([0, 1, 2]) };
  const { records, sharp } = edgesOf(triangle);
  expect([sharp, records.length / EDGE]).toEqual([3, 3]);
  const outline = [{ records, away: [0, 0, 0] as Point }];
  const out = new Float32Array(roomFor(outline));
  expect(writeSilhouettes(outline, 0, { at: [0, 0, 1], parallel: true }, out)).toBe(3);
});

it("rows of a matrix are read as they are written", () => {
  const rows = [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7, 0, 0, 0, 1];
  expect(matrixOf(rows).elements.slice(12, 15)).toEqual([5, 6, 7]);
  expect(matrixOf(null).elements).toEqual(matrixOf([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]).elements);
});

it("a box drawn as a point has nothing inside", () => {
  expect(isInside(boxRegion([3, 3], [3, 3]), [3, 3])).toBe(false);
});
