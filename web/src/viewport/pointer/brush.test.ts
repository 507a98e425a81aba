// Painting strokes: what a quick pointer passes over, and where one ends.
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import * as labels from "../../store/labels";
import { useScenes } from "../../store/scenes";
import { initialWorkspace, useWorkspace } from "../../store/workspace";
import { box, boxScene, stageOf, stubBrowser } from "../stage/boxes.test-help";
import { beginStroke, spotsBetween } from "./brush";

const scene = boxScene([box("a", [-3, 0, 0]), box("b", [-0.5, 0, 0]), box("c", [2, 0, 0])]);

beforeEach(() => {
  stubBrowser();
  useWorkspace.setState({ ...initialWorkspace, asset: "a", brush: "leg" }, true);
  useScenes.setState({ scene });
});
afterEach(() => {
  vi.restoreAllMocks();
});

it("a stroke paints all hulls between two spots far apart, once each, and ends with the drag", () => {
  const paint = vi.spyOn(labels, "paint").mockImplementation(() => undefined);
  const end = vi.spyOn(labels, "endStroke").mockImplementation(() => undefined);
  const stage = stageOf(scene);
  const pane = stage.panes()[0];
  const spotOf = (name: string): [number, number] => {
    const at = stage.shown?.hulls.middle(stage.shown.hulls.places.get(name) ?? -1, 0);
    const { x, y } = stage.pixelOf(at as never, pane as never);
    return [x, y];
  };
  const begun = beginStroke(stage, spotOf("a"));
  begun?.move(spotOf("c"));
  begun?.move(spotOf("a"));
  expect(paint.mock.calls.flat(2)).toEqual(["a", "b", "c"]);
  expect(end).not.toHaveBeenCalled();
  begun?.end({} as PointerEvent);
  expect(end).toHaveBeenCalledOnce();
});

it("spots between two are close to each other and end at the last", () => {
  const spots = spotsBetween([0, 0], [30, 40]);
  expect(spots.at(-1)).toEqual([30, 40]);
  expect(spots.length).toBeGreaterThanOrEqual(12);
  expect(spotsBetween([5, 5], [5, 5])).toEqual([[5, 5]]);
});
