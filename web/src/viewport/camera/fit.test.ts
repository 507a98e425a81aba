// Laws of fitting: all is seen, it touches the room, it is in its middle; the room is free.
import { Vector3 } from "three";
import { describe, expect, it, vi } from "vitest";
import { fit, freeRoom, type Rect, type Room, shapeOf, wholeRoom } from "./fit";
import type { Vec } from "../../store/vectors";
import { cornersOf, START } from "./pose";
import { CameraView } from "./view";

vi.stubGlobal("matchMedia", () => ({ matches: false }));

const LONG = cornersOf([-1, -0.2, 0, 3, 0.4, 1.5]);
const TALL = cornersOf([0, 0, 0, 0.3, 0.3, 4]);
const NEAR: Vec[] = [[0, 0, 0], [2, -3, 1], [0.1, 0.1, 0.1], [-1, 1, 0]];
const ROOMS: readonly Room[] = [wholeRoom(1.4), wholeRoom(0.6), { at: [0.3, -0.1], width: 0.5, height: 0.7 }, { at: [-0.4, 0.2], width: 0.4, height: 0.4 }];
const [WIDTH, HEIGHT] = [840, 600];

/** Where points are seen, from the middle of the room, in halves of its width and height. */
function spots(points: readonly Vec[], room: Room, projection: "perspective" | "orthographic", turn: number): [number, number][] {
  const view = new CameraView();
  view.projection = projection;
  view.resize(WIDTH, HEIGHT);
  view.pose = fit({ ...START, azimuth: START.azimuth + turn }, points, room, projection === "perspective");
  view.bounds = [-4, -4, -4, 4, 4, 4];
  return points.map((point) => {
    const { x, y } = view.pixelOf(new Vector3(...point));
    const [right, up] = [(x - WIDTH / 2) / HEIGHT - room.at[0], (HEIGHT / 2 - y) / HEIGHT - room.at[1]];
    return [right / (room.width / 2), up / (room.height / 2)];
  });
}

describe.each(["perspective", "orthographic"] as const)("in %s projection", (projection) => {
  it.each([0, 0.7, 2, 4])("what is fitted is in the room, fills it one way, and is in its middle, turned by %d", (turn) => {
    for (const room of ROOMS) {
      for (const points of [LONG, TALL, NEAR]) {
        const seen = spots(points, room, projection, turn);
        const ends = [0, 1].map((axis) => seen.map((spot) => spot[axis] ?? 0)).map((at) => [Math.min(...at), Math.max(...at)] as const);
        for (const [low, high] of ends) expect(low + high).toBeCloseTo(0, 3);
        const reach = Math.max(...ends.map(([, high]) => high));
        expect(reach).toBeLessThanOrEqual(1);
        if (points !== NEAR) expect(reach).toBeGreaterThan(0.85);
      }
    }
  });
});

it("a single point, or one in a line to the eye with another, is not come nearer to than can be", () => {
  expect(fit(START, [[1, 2, 3]], wholeRoom(1), true).height).toBeGreaterThan(0);
});

it("a shape is wider than high from its long side", () => {
  expect(shapeOf({ ...START, azimuth: -Math.PI / 2, elevation: 0 }, LONG)).toBeCloseTo(4 / 1.5, 6);
});

describe("the free room", () => {
  const cube: Rect = { left: 730, top: 10, right: 800, bottom: 80 };
  const words: Rect = { left: 10, top: 540, right: 310, bottom: 590 };
  const card: Rect = { left: 460, top: 300, right: 790, bottom: 480 };
  /** In pixels of a picture of 800 by 600. */
  const rect = ({ at, width, height }: Room): Rect => {
    const [x, y] = [400 + 600 * at[0], 300 - 600 * at[1]];
    return { left: x - 300 * width, right: x + 300 * width, top: y - 300 * height, bottom: y + 300 * height };
  };

  it("is the whole picture where nothing lies over it, or only beside it", () => {
    expect(freeRoom(800, 600, [], 1)).toEqual(wholeRoom(800 / 600));
    expect(freeRoom(800, 600, [{ left: 900, top: 0, right: 950, bottom: 600 }], 1)).toEqual(wholeRoom(800 / 600));
  });

  it.each([0.2, 1, 3])("has nothing over it, for a shape of %d", (shape) => {
    const covers = [cube, words, card];
    for (let count = 1; count <= 3; count++) {
      const room = rect(freeRoom(800, 600, covers.slice(0, count), shape));
      for (const one of covers.slice(0, count)) {
        const apart = one.right <= room.left + 1e-6 || one.left >= room.right - 1e-6 || one.bottom <= room.top + 1e-6 || one.top >= room.bottom - 1e-6;
        expect(apart).toBe(true);
      }
    }
  });

  it("is high for what is high, and wide for what is wide", () => {
    const [high, wide] = [0.2, 4].map((shape) => freeRoom(800, 600, [cube, words], shape));
    expect(high?.height).toBe(1);
    expect(wide?.width).toBeCloseTo(800 / 600, 9);
  });

  it("is the whole picture where too little would be left", () => {
    expect(freeRoom(800, 600, [{ left: 100, top: 100, right: 700, bottom: 500 }], 1)).toEqual(wholeRoom(800 / 600));
  });
});
