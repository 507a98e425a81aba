import { beforeEach, describe, expect, it, vi } from "vitest";
import { sheetOf } from "../../store/sheetScene";
import { initialWorkspace } from "../../store/workspace";
import { box, boxScene, renderer, stageOf, stubBrowser } from "./boxes.test-help";
import { settingsOf } from "./panes";
import { hullAt, pieceAt } from "./picking";

const left = box("left", [-3, 0, 0]);
const right = box("right", [2, 0, 0]);
const settings = (change: Partial<typeof initialWorkspace.view>) => settingsOf({ ...initialWorkspace.view, ...change });

/** The pixel of the middle of a hull. */
function pixelOf(stage: ReturnType<typeof stageOf>, name: string): [number, number] {
  const side = stage.shown;
  const pane = stage.panes().at(-1);
  const place = side?.hulls.places.get(name);
  if (!side || !pane || place === undefined) throw new Error(`${name} is not shown`);
  const { x, y } = stage.pixelOf(side.hulls.middle(place, stage.settings.explode), pane);
  return [x, y];
}

beforeEach(() => {
  stubBrowser();
});

describe("showing a scene", () => {
  it("frames another asset, from the same side", () => {
    const stage = stageOf(boxScene([left, right]));
    const { pose } = stage.view;
    stage.show(boxScene([box("big", [0, 0, 0], [9, 9, 9])], { asset: "b" }));
    stage.draw(renderer(), 1);
    expect(stage.view.pose.height).toBeGreaterThan(pose.height);
    expect([stage.view.pose.azimuth, stage.view.pose.elevation]).toEqual([pose.azimuth, pose.elevation]);
  });

  it("leaves the camera alone where the same asset is edited", () => {
    const stage = stageOf(boxScene([left, right]));
    const { pose } = stage.view;
    stage.show(boxScene([left]));
    stage.draw(renderer(), 1);
    expect(stage.view.pose).toEqual(pose);
    expect(stage.shown?.hulls.names).toEqual(["left"]);
  });

  it("is in parallel projection where several assets are side by side, so that sizes compare", () => {
    const stage = stageOf(boxScene([left]));
    const sheet = sheetOf([boxScene([left], { asset: "a" }), boxScene([right], { asset: "b" })], "a");
    const seen = [sheet, boxScene([left])].map((scene) => {
      stage.show(scene);
      return stage.view.projection;
    });
    expect(seen).toEqual(["orthographic", "perspective"]);
  });

  it("draws nothing anew where only labels changed", () => {
    const scene = boxScene([left, right]);
    const stage = stageOf(scene);
    const before = stage.shown;
    stage.show({ ...scene, hulls: scene.hulls.map((hull) => ({ ...hull, label: "leg" })) });
    expect(stage.shown).toBe(before);
    expect(stage.shown?.scene.hulls[0]?.label).toBe("leg");
  });

  it("asks for a frame, and tells who listens when it is drawn", () => {
    const stage = stageOf(null);
    const [asked, drawn] = [vi.fn(), vi.fn()];
    stage.invalidate = asked;
    const stop = stage.onDrawn(drawn);
    stage.show(boxScene([left]));
    expect(asked).toHaveBeenCalled();
    stage.draw(renderer(), 1);
    stop();
    stage.draw(renderer(), 2);
    expect(drawn).toHaveBeenCalledOnce();
  });
});

describe("what is under a pixel", () => {
  it("is the hull whose middle is there", () => {
    const stage = stageOf(boxScene([left, right]));
    expect(hullAt(stage, ...pixelOf(stage, "left"))).toBe("left");
    expect(hullAt(stage, ...pixelOf(stage, "right"))).toBe("right");
    expect(hullAt(stage, 0, 0)).toBeNull();
  });

  it("is the nearer of two", () => {
    const stage = stageOf(boxScene([box("front", [0, -3, 0]), box("behind", [0, 3, 0])]));
    stage.view.lookFrom("front", -1);
    stage.draw(renderer(), 1);
    expect(hullAt(stage, ...pixelOf(stage, "behind"))).toBe("front");
  });

  it("is not a hull that is hidden", () => {
    const stage = stageOf(boxScene([left, right]));
    const spot = pixelOf(stage, "left");
    const side = stage.shown;
    if (side) side.hulls.visible[side.hulls.places.get("left") ?? -1] = false;
    expect(hullAt(stage, ...spot)).toBeNull();
  });

  it("moves with the hulls in the exploded view", () => {
    const stage = stageOf(boxScene([left, right]));
    const before = pixelOf(stage, "left");
    stage.set(settings({ explode: 1 }));
    const after = pixelOf(stage, "left");
    expect(after).not.toEqual(before);
    expect(hullAt(stage, ...after)).toBe("left");
  });

  it("can be a non-convex piece, as long as these are shown", () => {
    const piece = box("shell", [0, 0, 0]);
    const scene = boxScene([left, right], { opaque: [{ ...piece, reason: "not convex" }] as never });
    const stage = stageOf(scene);
    const { x, y } = stage.pixelOf([0.5, 0.5, 0.5], stage.panes()[0] as never);
    expect(pieceAt(stage, x, y)).toBe("shell");
    expect(hullAt(stage, x, y)).toBeNull();
    stage.set(settings({ opaque: false }));
    expect(pieceAt(stage, x, y)).toBeNull();
  });
});

describe("before and after", () => {
  it("are two pictures beside each other, with hulls of their own", () => {
    const stage = stageOf(boxScene([left], { edit: { made: [], removed: ["right"] } as never }));
    stage.contents.compareWith(boxScene([left, right]));
    stage.set(settings({ compare: "side", grid: false }));
    const drawn: { viewport: number[] }[] = [];
    stage.draw(renderer(drawn), 1);
    expect(drawn.map(({ viewport }) => viewport)).toEqual([
      [0, 0, 200, 300],
      [200, 0, 200, 300],
    ]);
    expect(stage.sideOf(stage.paneAt(10))?.hulls.names).toEqual(["left", "right"]);
    expect(stage.sideOf(stage.paneAt(390))?.hulls.names).toEqual(["left"]);
  });

  it("are one picture where there is nothing to compare with", () => {
    const stage = stageOf(boxScene([left]));
    stage.set(settings({ compare: "side" }));
    expect(stage.panes()).toHaveLength(1);
  });
});

describe("what is shown as a whole", () => {
  const before = boxScene([left, right, box("high", [0, 0, 6])]);
  const edited = boxScene([left, right], { edit: { made: [], removed: ["high"] } as never });
  /** Where the corners of all hulls are seen, in a pane. */
  const seen = (stage: ReturnType<typeof stageOf>) =>
    stage.panes().flatMap((pane) => {
      const { positions } = stage.sideOf(pane)?.hulls.shapes ?? { positions: [] };
      return Array.from({ length: positions.length / 3 }, (_, k) => {
        const { x, y } = stage.pixelOf([0, 1, 2].map((axis) => positions[3 * k + axis] ?? 0) as never, pane);
        return [x - pane.x, y, pane.width] as const;
      });
    });
  const isInside = ([x, y, width]: readonly [number, number, number]) => x >= 0 && x <= width && y >= 0 && y <= 300;

  it.each(["side", "slider"] as const)("stays so with before and after in view (%s), each pane filled", (compare) => {
    const stage = stageOf(edited);
    stage.contents.compareWith(before);
    stage.set(settings({ compare }));
    stage.draw(renderer(), 1);
    const spots = seen(stage);
    expect(spots.every(isInside)).toBe(true);
    const reach = (axis: 0 | 1) => Math.max(...spots.map((spot) => spot[axis])) - Math.min(...spots.map((spot) => spot[axis]));
    expect(Math.max(reach(0) / (spots[0]?.[2] ?? 1), reach(1) / 300)).toBeGreaterThan(0.8);
  });

  it("stays as the person has placed it, once that was done", () => {
    const stage = stageOf(edited);
    stage.moveCamera((view) => view.zoom(0.3, 200, 150));
    const { pose } = stage.view;
    stage.contents.compareWith(before);
    stage.set(settings({ compare: "slider" }));
    stage.draw(renderer(), 1);
    expect(stage.view.pose).toEqual(pose);
  });

  it("is beside what lies over the picture, in each pane", () => {
    const stage = stageOf(null);
    stage.covers = () => [{ left: 0, top: 0, right: 400, bottom: 60 }, { left: 330, top: 0, right: 400, bottom: 300 }];
    stage.show(boxScene([left, right]));
    stage.draw(renderer(), 1);
    for (const [x, y] of seen(stage)) expect([x < 330, y > 60]).toEqual([true, true]);
    stage.contents.compareWith(before);
    stage.set(settings({ compare: "side" }));
    stage.draw(renderer(), 2);
    for (const [x, y] of seen(stage)) expect([x < 130, y > 60]).toEqual([true, true]);
  });
});

describe("framing", () => {
  it("some hulls comes nearer than framing all", () => {
    const stage = stageOf(boxScene([left, right]));
    const all = stage.view.pose.height;
    stage.frame(new Set(["left"]), null);
    expect(stage.view.pose.height).toBeLessThan(all);
    const [x, y] = pixelOf(stage, "left");
    expect([Math.abs(x - 200) < 40, Math.abs(y - 150) < 40]).toEqual([true, true]);
    stage.frame(null, null);
    expect(stage.view.pose.height).toBeCloseTo(all, 6);
  });

  it("looks at hulls of an asset as soon as it is shown", () => {
    const stage = stageOf(boxScene([left, right]));
    stage.lookAt("b", new Set(["small"]));
    stage.draw(renderer(), 1);
    stage.show(boxScene([box("wide", [0, 0, 0], [9, 9, 1]), box("small", [0, 0, 2], [0.5, 0.5, 0.5])], { asset: "b" }));
    stage.draw(renderer(), 2);
    const whole = stage.view.pose.height;
    stage.draw(renderer(), 3);
    expect(stage.view.pose.height).toBeLessThan(whole);
  });

  it("forgets what was wanted of an asset that is not opened", () => {
    const stage = stageOf(boxScene([left, right]));
    stage.lookAt("b", new Set(["left"]));
    stage.show(boxScene([left, right], { asset: "c" }));
    stage.draw(renderer(), 1);
    const { pose } = stage.view;
    stage.draw(renderer(), 2);
    expect(stage.view.pose).toEqual(pose);
  });
});

it("is seen from the eye in the frame of the file, whichever way the asset is turned", () => {
  const upright = [0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1];
  const scene = boxScene([left]);
  const stage = stageOf({ ...scene, view: { ...scene.view, upright } });
  const { at, parallel } = stage.eye(stage.view.camera());
  const { position } = stage.view.camera();
  expect(parallel).toBe(false);
  expect([at[2], at[1], -at[0]].map((value) => Math.round(value * 1e6))).toEqual(position.toArray().map((value) => Math.round(value * 1e6)));
});
