
import { Color } from "three";
import { beforeAll, expect, it, vi } from "vitest";
import { wholeRoom } from "../camera/fit";
import { axesOf, START } from "../camera/pose";
import { AssetDrawing } from "../drawing/assetDrawing";
import type { ThemeColors } from "../drawing/themeColors";
import type { Scene } from "../../store/scenes";
import type { Stage } from "./stage";
import { findViewpoint as find } from "./viewpoint";

const findViewpoint = (stage: Stage, names: ReadonlySet<string>) => find(stage, names, wholeRoom(1.2));

beforeAll(() => {
  vi.stubGlobal("matchMedia", () => ({ matches: false }));
});

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, (k >> 2) & 1] as const);
const FACES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];

/** A box given by its lowest corner and its sizes. */
function box(name: string, low: readonly number[], size: readonly number[]) {
  const positions = CORNERS.flatMap((corner) => corner.map((c, axis) => (low[axis] ?? 0) + c * (size[axis] ?? 0)));
  return { name, shape: { positions: new Float32Array(positions), index: new Uint32Array(FACES) } };
}

const color = new Color();
const ink = { selected: color, hover: color, removed: color, pale: color, unlabelled: color } as unknown as ThemeColors;

function stageOf(...hulls: ReturnType<typeof box>[]): Stage {
  const scene = { asset: "a", hulls, opaque: [], view: { upright: null, hulls } } as unknown as Scene;
  const view = { pose: START, projection: "perspective" };
  return { shown: new AssetDrawing(scene, [0, 0, 0], ink), view, settings: { explode: 0 } } as unknown as Stage;
}

const wall = box("wall", [-2, -2, 0], [4, 0.1, 3]);
const whole = box("whole", [-2, -2, 0], [4, 4, 0.1]);
const button = (y: number) => box("button", [0, y, 1], [0.2, 0.2, 0.2]);

it("keeps the side that one looks from where the hull is seen from there", () => {
  const pose = findViewpoint(stageOf(whole, button(0)), new Set(["button"]));
  expect([pose?.azimuth, pose?.elevation]).toEqual([START.azimuth, START.elevation]);
});

it("leaves room for what is around the hull", () => {
  const pose = findViewpoint(stageOf(whole, button(0)), new Set(["button"]));
  expect(pose?.height).toBeGreaterThan(2);
});

it("goes round to where a hidden hull is seen", () => {
  const pose = findViewpoint(stageOf(whole, wall, button(-1.8)), new Set(["button"]));
  const [, back] = axesOf(pose ?? START).eye;
  const [, front] = axesOf(START).eye;
  expect(front).toBeLessThan(0);
  expect(back).toBeGreaterThan(front);
});

it("takes the best of bad sides for a hull within another", () => {
  expect(findViewpoint(stageOf(box("case", [0, 0, 0], [1, 1, 1]), box("kernel", [0.4, 0.4, 0.4], [0.2, 0.2, 0.2])), new Set(["kernel"]))).not.toBeNull();
});

it("does nothing for hulls that are not there", () => {
  expect(findViewpoint(stageOf(whole), new Set(["gone"]))).toBeNull();
});
