// Colouring pictures of the server.
import { encode } from "fast-png";
import { expect, test } from "vitest";
import type { Fill } from "./hullColors";
import { type Paint, paintPixels, readIdMap } from "./idMap";

const map = (pixels: number[][], width = pixels.length) =>
  readIdMap(encode({ width, height: pixels.length / width, data: new Uint8Array(pixels.flat()) }));

const pixel = (data: Uint8ClampedArray, k: number) => [...data.subarray(4 * k, 4 * k + 4)];

const red: Paint = { color: (k) => (k === 0 ? [200, 0, 0] : k < 0 ? [90, 90, 90] : [0, 0, 100]) };

test("red and green together number the hull, also where it is hardly covered", () => {
  const numbers: number[] = [];
  paintPixels(map([[1, 2, 0, 255], [0, 1, 0, 3]]), { color: (k) => (numbers.push(k), [0, 0, 0]) });
  expect(numbers).toEqual([257, 0]);
});

test("what is no such PNG is refused", () => {
  expect(() => readIdMap(new Uint8Array([1, 2, 3]))).toThrow();
  expect(() => readIdMap(encode({ width: 1, height: 1, data: new Uint8Array(3), channels: 3 }))).toThrow("another kind");
});

test("a pixel takes the colour of its hull, its shade and its coverage", () => {
  const out = paintPixels(map([[0, 1, 255, 255], [0, 1, 51, 128], [0, 2, 255, 255]]), red);
  expect(pixel(out, 0)).toEqual([200, 0, 0, 255]);
  expect(pixel(out, 1)).toEqual([40, 0, 0, 128]);
  expect(pixel(out, 2)).toEqual([0, 0, 100, 255]);
});

test("what is covered by no hull is a non-convex piece; where nothing is, nothing is painted", () => {
  const out = paintPixels(map([[0, 0, 255, 255], [0, 0, 255, 0]]), red);
  expect(pixel(out, 0)).toEqual([90, 90, 90, 255]);
  expect(pixel(out, 1)).toEqual([0, 0, 0, 0]);
});

test("outlined hulls have a dark line within their edge", () => {
  const ids = Array.from({ length: 64 }, (_, k) => (k % 8 ? 1 : 2));
  const out = paintPixels(map(ids.map((id) => [0, id, 255, 255]), 8), { ...red, fill: (k) => (k === 0 ? "outlined" : "solid") });
  expect([27, 26, 24].map((k) => pixel(out, k)[k === 24 ? 2 : 0])).toEqual([200, 50, 100]);
});

test("hatched hulls show lighter stripes, dotted ones darker dots on a paler ground, others neither", () => {
  const row = Array.from({ length: 20 }, () => [0, 1, 255, 255]);
  const greens = (fill: Fill) => new Set(Array.from(paintPixels(map(row), { ...red, fill: () => fill })).filter((_, k) => k % 4 === 1));
  expect(greens("solid")).toEqual(new Set([0]));
  expect(greens("hatched").size).toBe(2);
  const [dot = 0, ground = 0] = [...greens("dotted")].sort((a, b) => a - b);
  expect(greens("dotted").size).toBe(2);
  expect(dot).toBeLessThan(0.75 * ground);
});
