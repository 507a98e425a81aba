// Several assets in one scene: none overlaps another, rows go across the usual view, and shapes stay the same objects.
import { describe, expect, it } from "vitest";
import { START } from "../viewport/camera/pose";
import { box, boxScene } from "../viewport/stage/boxes.test-help";
import { placeOf } from "./hullPlaces";
import type { Scene } from "./scene";
import { SHEET_AZIMUTH, sheetOf } from "./sheetScene";

const table = (asset: string, size = 1): Scene =>
  boxScene([box("top", [5, 0, size], [2 * size, size, 0.1 * size]), box("leg", [5, 0, 0], [0.1, 0.1, size])], { asset, contacts: [["top", "leg"]] });
const scenes = ["a", "b", "c", "d", "e", "f", "g", "h"].map((asset) => table(asset));

/** Whether two boxes on the ground overlap. */
function overlap(a: { low: readonly number[]; high: readonly number[] }, b: typeof a): boolean {
  return [0, 1].every((axis) => (a.low[axis] ?? 0) < (b.high[axis] ?? 0) && (b.low[axis] ?? 0) < (a.high[axis] ?? 0));
}

describe("assets side by side", () => {
  const sheet = sheetOf(scenes, "c");

  it("stand on the ground, and none overlaps another", () => {
    const parts = sheet?.parts ?? [];
    expect(parts.map(({ asset }) => asset)).toEqual(scenes.map(({ asset }) => asset));
    parts.forEach((one, k) => {
      expect(one.low[2]).toBeCloseTo(0);
      for (const other of parts.slice(k + 1)) expect(overlap(one, other)).toBe(false);
    });
  });

  it("have the hulls of the open one first, by names that tell the asset", () => {
    expect(sheet?.hulls.map(({ name }) => placeOf(name)?.asset).slice(0, 3)).toEqual(["c", "c", "a"]);
    expect(placeOf(sheet?.hulls[1]?.name ?? "")).toEqual({ asset: "c", hull: "leg" });
    expect(sheet?.contacts.length).toBe(scenes.length);
    expect(new Set(sheet?.hulls.map(({ name }) => name)).size).toBe(2 * scenes.length);
  });

  it("keep their shapes as long as they stand where they stood, and others after one is gone", () => {
    const again = sheetOf(scenes, "c");
    expect(again?.hulls.every(({ shape }, k) => shape === sheet?.hulls[k]?.shape)).toBe(true);
  });

  it.each([
    [2, false, 1],
    [100, false, 1],
    [2, true, 1],
    [100, true, 0.01],
  ])("%s times as large and one size wished %s: drawn by %s", (times, oneSize, scale) => {
    const other = sheetOf([table("x"), table("y", times)], "x", oneSize);
    const [one, two] = other?.parts ?? [];
    expect(two?.scale).toBeCloseTo(scale, 3);
    expect(two?.high[2]).toBeCloseTo(scale * times * (one?.high[2] ?? 0), 3);
    expect(other?.isUneven).toBe(times > 3);
  });
});

it("rows go across the side that one looks from at first", () => {
  expect(SHEET_AZIMUTH).toBe(START.azimuth);
});
