// Polygons of hulls that are cut open, and what is met through a section plane.
import { describe, expect, it } from "vitest";
import type { SectionPlane } from "../../store/section";
import { box } from "../stage/boxes.test-help";
import { axesIn, beyond, castThrough, contains, cutPolygon } from "./section";
import { mergeShapes, type Point } from "./triangles";

const shapes = mergeShapes([box("left", [0, 0, 0]).shape, box("right", [1, 0, 0]).shape]);
const placed = { shapes, visible: [true, true], aways: [[0, 0, 0], [0, 0, 0]] as Point[] };
const up = (at: number): SectionPlane => ({ normal: [0, 0, 1], at });
const cast = (from: Point, along: Point, plane: SectionPlane | null) => castThrough(placed, { from, along }, 0, plane);

describe("the polygon of a cut", () => {
  it.each([[[0, 0, 1]], [[1, 0, 0]], [[0, 0.6, 0.8]], [[1 / Math.sqrt(3), 1 / Math.sqrt(3), 1 / Math.sqrt(3)]]])(
    "lies in the plane, on the hull, and is convex: %j",
    (normal) => {
      const plane = { normal: normal as [number, number, number], at: 0.5 };
      const corners = cutPolygon(shapes, 0, plane, [0, 0, 0]);
      expect(corners.length).toBeGreaterThanOrEqual(3);
      for (const corner of corners) {
        expect(beyond(plane, corner)).toBeCloseTo(0, 5);
        expect(Math.min(...corner)).toBeGreaterThanOrEqual(-1e-6);
        expect(Math.max(...corner)).toBeLessThanOrEqual(1 + 1e-6);
      }
    },
  );

  it("of a box across has the area of its side", () => {
    const corners = cutPolygon(shapes, 0, up(0.3), [0, 0, 0]);
    const area = corners.reduce((sum, [x, y], k) => {
      const [p, q] = corners[(k + 1) % corners.length] ?? [0, 0];
      return sum + (x * q - p * y) / 2;
    }, 0);
    expect(Math.abs(area)).toBeCloseTo(1, 5);
  });

  it("is none where the plane passes by, and goes with the hull in the exploded view", () => {
    expect(cutPolygon(shapes, 0, up(1.5), [0, 0, 0])).toEqual([]);
    expect(cutPolygon(shapes, 0, up(1.5), [0, 0, 1]).length).toBeGreaterThanOrEqual(4);
  });
});

describe("a ray through a section plane", () => {
  const down: Point = [0, 0, -1];

  it("meets the inside of the hull that is cut open, at the plane", () => {
    expect(cast([0.5, 0.5, 5], down, up(0.25))).toEqual({ place: 0, distance: 4.75 });
    expect(cast([1.5, 0.5, 5], down, up(0.25))).toEqual({ place: 1, distance: 4.75 });
  });

  it("meets nothing beyond the plane, from either side", () => {
    expect(cast([0.5, 5, 0.6], [0, -1, 0], up(0.25))).toBeNull();
    expect(cast([0.5, 0.5, -5], [0, 0, 1], up(-1))).toBeNull();
  });

  it("from the side in sight meets what it did without the plane", () => {
    const from: Point = [0.5, 0.5, -5];
    expect(cast(from, [0, 0, 1], up(0.25))).toEqual(cast(from, [0, 0, 1], null));
  });

  it("meets the first hull behind the plane where it cuts none", () => {
    expect(cast([0.5, 0.5, 5], down, up(2))).toEqual({ place: 0, distance: 4 });
  });
});

it("a point is in a hull or not", () => {
  expect(contains(shapes, 0, [0.5, 0.5, 0.5])).toBe(true);
  expect(contains(shapes, 0, [0.5, 0.5, 1.01])).toBe(false);
  expect(contains(shapes, 1, [0.5, 0.5, 0.5])).toBe(false);
});

it.each([[[0, 0, 1]], [[0, 1, 0]], [[0.6, 0, 0.8]]])("two directions in a plane are square to its normal and each other: %j", (normal) => {
  const { u, v } = axesIn(normal as unknown as Point);
  const dot = (a: readonly number[], b: readonly number[]) => a.reduce((sum, value, k) => sum + value * (b[k] ?? 0), 0);
  expect([dot(u, v), dot(u, normal), dot(v, normal)].map((value) => Math.abs(value))).toEqual([expect.closeTo(0), expect.closeTo(0), expect.closeTo(0)]);
  expect([Math.hypot(...u), Math.hypot(...v)]).toEqual([expect.closeTo(1), expect.closeTo(1)]);
});
