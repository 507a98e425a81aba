// What each tool does with clicks and drags on a stage of boxes.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { initialCut, useCut } from "../../store/cut";
import * as labels from "../../store/labels";
import { useScenes } from "../../store/scenes";
import { initialWorkspace, select, useWorkspace } from "../../store/workspace";
import { box, boxScene, stageOf, stubBrowser } from "../stage/boxes.test-help";
import { useRegion } from "../stage/regionStore";
import type { Stage } from "../stage/stage";
import { createPointerTool } from "./tools";

const NOTHING = { shiftKey: false, ctrlKey: false, metaKey: false, altKey: false };
const press = (keys: Partial<typeof NOTHING> = {}) => ({ ...NOTHING, ...keys }) as PointerEvent;
const now = () => useWorkspace.getState();
const selected = () => [...now().selection].sort();
const scene = boxScene([box("left", [-3, 0, 0]), box("right", [2, 0, 0]), box("far", [0, 12, 0])]);
const EMPTY: [number, number] = [1, 1];
let stage: Stage;

function spotOf(name: string): [number, number] {
  const side = stage.shown;
  const pane = stage.panes()[0];
  if (!side || !pane) throw new Error("nothing is shown");
  const { x, y } = stage.pixelOf(side.hulls.middle(side.hulls.places.get(name) ?? -1, 0), pane);
  return [x, y];
}

function click(spot: [number, number], keys: Partial<typeof NOTHING> = {}): void {
  createPointerTool(stage).click(spot, press(keys));
}

/** Drags from one spot to others; the event at its end has the same keys. */
function drag(from: [number, number], to: readonly [number, number][], keys: Partial<typeof NOTHING> = {}): boolean {
  const begun = createPointerTool(stage).begin(from, press(keys));
  for (const spot of to) begun?.move(spot);
  begun?.end(press(keys));
  return begun !== null;
}

beforeEach(() => {
  stubBrowser();
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useScenes.setState({ scene });
  useRegion.setState({ drawn: [], region: new Set() });
  useCut.setState(initialCut);
  vi.spyOn(labels, "paint").mockImplementation(() => undefined);
  vi.spyOn(labels, "endStroke").mockImplementation(() => undefined);
  stage = stageOf(scene);
});

afterEach(() => {
  vi.restoreAllMocks();
});

describe("a click", () => {
  it("selects the hull under it, in place of those before", () => {
    click(spotOf("left"));
    click(spotOf("right"));
    expect(selected()).toEqual(["right"]);
  });

  it("adds with Shift, and toggles with Ctrl or the command key", () => {
    click(spotOf("left"));
    click(spotOf("right"), { shiftKey: true });
    expect(selected()).toEqual(["left", "right"]);
    click(spotOf("left"), { ctrlKey: true });
    expect(selected()).toEqual(["right"]);
    click(spotOf("left"), { metaKey: true });
    expect(selected()).toEqual(["left", "right"]);
  });

  it("on nothing clears the selection, but with a key held", () => {
    select(["left"]);
    click(EMPTY, { shiftKey: true });
    expect(selected()).toEqual(["left"]);
    click(EMPTY);
    expect(selected()).toEqual([]);
  });

  it("paints with the brush, and selects nothing", () => {
    useWorkspace.setState({ brush: "leg" });
    click(spotOf("left"));
    click(EMPTY);
    expect(vi.mocked(labels.paint).mock.calls).toEqual([[["left"]]]);
    expect(selected()).toEqual([]);
  });

  it("marks where a direction starts, then where it ends, then begins again", () => {
    useWorkspace.setState({ tool: "landmark" });
    click(spotOf("left"));
    click(EMPTY);
    click(spotOf("right"));
    expect(now().landmarks).toEqual(["left", "right"]);
    click(spotOf("far"));
    expect(now().landmarks).toEqual(["far"]);
  });

  it("chooses the hull to cut", () => {
    useWorkspace.setState({ tool: "cut" });
    click(spotOf("right"));
    click(EMPTY);
    expect(selected()).toEqual(["right"]);
  });
});

describe("the pointer over the picture", () => {
  it("points at the hull under it, and at none outside", () => {
    const tool = createPointerTool(stage);
    tool.hover(spotOf("left"));
    expect(now().hover).toBe("left");
    tool.hover(EMPTY);
    expect(now().hover).toBeNull();
    tool.hover(spotOf("left"));
    tool.hover(null);
    expect(now().hover).toBeNull();
  });
});

describe("a box", () => {
  const whole: [number, number] = [399, 299];

  it("selects the hulls that are completely inside, and is put away", () => {
    useWorkspace.setState({ tool: "box" });
    drag([0, 0], [whole]);
    expect(selected()).toEqual(["far", "left", "right"]);
    expect(now().tool).toBe("select");
    expect(useRegion.getState().drawn).toEqual([]);
  });

  it("takes none that sticks out, and shows what it would take while it is drawn", () => {
    useWorkspace.setState({ tool: "box" });
    const [x, y] = spotOf("left");
    const begun = createPointerTool(stage).begin([0, 0], press());
    begun?.move([x, y]);
    expect([...useRegion.getState().region]).toEqual([]);
    begun?.move(whole);
    expect([...useRegion.getState().region].sort()).toEqual(["far", "left", "right"]);
    begun?.cancel();
    expect(selected()).toEqual([]);
    expect(useRegion.getState().region.size).toBe(0);
  });

  it("leaves hidden hulls alone", () => {
    const side = stage.shown;
    if (side) side.hulls.visible[side.hulls.places.get("far") ?? -1] = false;
    useWorkspace.setState({ tool: "box" });
    drag([0, 0], [whole]);
    expect(selected()).toEqual(["left", "right"]);
  });

  it("adds with Shift and takes away with Alt, and stays in hand", () => {
    useWorkspace.setState({ tool: "box", selection: new Set(["left"]) });
    drag([0, 0], [whole], { altKey: true });
    expect([selected(), now().tool]).toEqual([[], "box"]);
    drag([0, 0], [whole], { shiftKey: true });
    expect([selected(), now().tool]).toEqual([["far", "left", "right"], "box"]);
  });
});

it("a lasso takes what it goes round", () => {
  useWorkspace.setState({ tool: "lasso" });
  const [x, y] = spotOf("right");
  const away = 75;
  drag([x - away, y - away], [[x + away, y - away], [x + away, y + away], [x - away, y + away]]);
  expect(selected()).toContain("right");
  expect(selected()).not.toContain("left");
});

describe("a drag with the brush", () => {
  it("paints each hull that it goes over once", () => {
    useWorkspace.setState({ brush: "leg" });
    const [left, right] = [spotOf("left"), spotOf("right")];
    drag(left, [left, right, left, right]);
    expect(vi.mocked(labels.paint).mock.calls).toEqual([[["left"]], [["right"]]]);
  });

  it("that begins on nothing moves the camera", () => {
    useWorkspace.setState({ brush: "leg" });
    expect(drag(EMPTY, [spotOf("left")])).toBe(false);
    expect(labels.paint).not.toHaveBeenCalled();
  });

  it("without the brush moves the camera, also from a hull", () => {
    expect(drag(spotOf("left"), [EMPTY])).toBe(false);
  });
});

describe("through hulls", () => {
  const row = boxScene([box("front", [0, 0, 0]), box("back", [-6, 3, -6], [12, 1, 12]), box("beside", [6, -3, 0])]);
  /** The middle of `front`, with `back` behind it. */
  let spot: [number, number];

  beforeEach(() => {
    useScenes.setState({ scene: row });
    stage = stageOf(row);
    spot = spotOf("front");
  });

  it("a click takes the first; with Alt the next one behind, and after the last the first again", () => {
    const tool = createPointerTool(stage);
    const taken = [{}, { altKey: true }, { altKey: true }].map((keys) => {
      tool.click(spot, press(keys));
      return selected();
    });
    expect(taken).toEqual([["front"], ["back"], ["front"]]);
  });

  it("a click again in one place goes on behind only while one selects through", () => {
    const tool = createPointerTool(stage);
    tool.click(spot, press());
    tool.click(spot, press());
    expect(selected()).toEqual(["front"]);
    useWorkspace.setState({ through: true });
    tool.click(spot, press());
    expect(selected()).toEqual(["back"]);
  });

  it("with Shift, the one behind is added in place of the one before it", () => {
    select(["beside"]);
    const tool = createPointerTool(stage);
    tool.click(spot, press({ shiftKey: true }));
    tool.click(spot, press({ shiftKey: true, altKey: true }));
    expect(selected()).toEqual(["back", "beside"]);
  });

  it("a box takes what it only touches behind others, also where that is switched on during the drag", () => {
    useWorkspace.setState({ tool: "box" });
    const [x, y] = spot;
    const begun = createPointerTool(stage).begin([x - 2, y - 2], press());
    begun?.move([x + 2, y + 2]);
    expect([...useRegion.getState().region]).toEqual([]);
    useWorkspace.setState({ through: true });
    expect([...useRegion.getState().region].sort()).toEqual(["back", "front"]);
    begun?.end(press());
    expect(selected()).toEqual(["back", "front"]);
  });
});

describe("the cutting tool", () => {
  beforeEach(() => useWorkspace.setState({ tool: "cut", selection: new Set(["right"]) }));

  it("slides the plane along its axis", () => {
    const [x, y] = spotOf("right");
    const pane = stage.panes()[0];
    if (!pane) return;
    const [a, b] = [stage.pixelOf([2.5, 0.5, 0.5], pane), stage.pixelOf([2.75, 0.5, 0.5], pane)];
    drag([x, y], [[x + b.x - a.x, y + b.y - a.y]]);
    expect(useCut.getState().share).toBeCloseTo(0.75, 1);
  });

  it("moves the camera where the drag begins elsewhere", () => {
    expect(drag(spotOf("left"), [[200, 200]])).toBe(false);
    expect(useCut.getState().share).toBe(0.5);
  });

  it("takes a free plane through the line that is drawn", () => {
    useCut.setState({ axis: "free" });
    const [x, y] = spotOf("right");
    drag([x, y - 60], [[x, y], [x, y + 60]]);
    const { drawn, share } = useCut.getState();
    const { right } = { right: stage.view.camera().matrixWorld.elements.slice(0, 3) };
    const along = Math.abs((drawn ?? []).reduce((sum, value, k) => sum + value * (right[k] ?? 0), 0));
    expect(along).toBeGreaterThan(0.95);
    expect(share).toBeGreaterThan(0.2);
    expect(share).toBeLessThan(0.8);
  });

  it("does nothing before a hull is chosen", () => {
    select([]);
    expect(drag(spotOf("right"), [[0, 0]])).toBe(false);
  });
});

it("regions are drawn by box and lasso only", () => {
  const draws = (["select", "box", "lasso", "cut", "landmark"] as const).filter((tool) => {
    useWorkspace.setState({ tool });
    return createPointerTool(stage).drawsRegion();
  });
  expect(draws).toEqual(["box", "lasso"]);
});
