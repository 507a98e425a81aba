
import { expect, test } from "vitest";
import { hullToCut, initialCut, planeOf, setCut, shareAt, useCut } from "./cut";
import type { Scene, SceneHull } from "./scenes";

const positions = new Float32Array([0, 0, 0, 4, 0, 0, 0, 2, 0, 0, 0, 1, 4, 2, 1]);
const hull = { name: "top", made: false, shape: { positions, index: new Uint32Array() } } as unknown as SceneHull;
// turns the file's Y up to Z
const standing = [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1];
const scene = (upright: number[] | null) => ({ view: { upright }, hulls: [hull, { ...hull, name: "box", made: true }] }) as unknown as Scene;

test("a plane in the middle goes through the middle of the hull", () => {
  expect(planeOf(scene(null), hull, initialCut)).toEqual({ hull: "top", at: [2, 1, 0.5], across: [1, 0, 0], span: 4 });
});

test("an axis is meant as the asset is shown, and told in the frame of the file", () => {
  const plane = planeOf(scene(standing), hull, { ...initialCut, axis: "z", share: 0.25 });
  expect(plane?.across).toEqual([0, 1, 0]);
  expect(plane?.at).toEqual([2, 0.5, 0.5]);
});

test("a free plane is there once it is drawn", () => {
  expect(planeOf(scene(null), hull, { ...initialCut, axis: "free" })).toBeNull();
  expect(planeOf(scene(null), hull, { axis: "free", share: 0.5, drawn: [0, 0, 1] })?.span).toBe(1);
});

test("the share of a point of the plane is the share that the plane was given", () => {
  const plane = planeOf(scene(null), hull, { ...initialCut, share: 0.3 });
  expect(plane && shareAt(hull, plane.across, plane.at)).toBeCloseTo(0.3, 6);
});

test("only one selected hull that no step made can be cut", () => {
  expect(hullToCut(scene(null), new Set(["top"]))?.name).toBe("top");
  expect(hullToCut(scene(null), new Set(["box"]))).toBeNull();
  expect(hullToCut(scene(null), new Set(["top", "box"]))).toBeNull();
});

test("the plane stays within the hull", () => {
  setCut({ share: 3 });
  expect(useCut.getState().share).toBeLessThan(1);
});
