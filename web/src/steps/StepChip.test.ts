// Keys on a step, and the hulls that are selected when it is shown.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import * as draft from "../store/draft";
import * as edits from "../store/edits";
import * as store from "../store/steps";
import type { AssetView } from "../wire";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import { clickAction, hullsAfter, keyAction } from "./StepChip";

const view = { asset: "a", steps: [] } as unknown as AssetView;
const action = (key: string, place: number, altKey = false) => keyAction({ key, altKey } as never, view, place, 3);

beforeEach(() => {
  vi.spyOn(draft, "draftStep").mockResolvedValue();
  vi.spyOn(edits, "perform").mockResolvedValue(true);
  vi.spyOn(store, "removeStep").mockResolvedValue(true);
});

afterEach(() => {
  vi.restoreAllMocks();
});

describe("a key on a step", () => {
  it("changes it by Enter", async () => {
    action("Enter", 1)?.();
    await vi.waitFor(() => expect(draft.draftStep).toHaveBeenCalledWith(1));
  });

  it("removes it here by Delete or Backspace", () => {
    action("Delete", 0)?.();
    action("Backspace", 2)?.();
    expect(vi.mocked(store.removeStep).mock.calls).toEqual([
      ["a", 0],
      ["a", 2],
    ]);
  });

  it("moves its rule by Alt and an arrow, not beyond the ends", () => {
    action("ArrowLeft", 1, true)?.();
    action("ArrowRight", 1, true)?.();
    expect(vi.mocked(edits.perform).mock.calls.map(([edit]) => edit)).toEqual([
      { kind: "move-rule", rule: 2, to: 1 },
      { kind: "move-rule", rule: 2, to: 3 },
    ]);
    expect([action("ArrowLeft", 0, true), action("ArrowRight", 2, true)]).toEqual([null, null]);
  });

  it("is left to the strip where it means nothing here", () => {
    expect([action("ArrowLeft", 1), action("x", 1)]).toEqual([null, null]);
  });
});

it("after a step what is left of its hulls is selected, and what it made", () => {
  const step = { select: ["x", "y"], removed: ["x"], made: ["m"] } as never;
  expect(hullsAfter(step)).toEqual(["y", "m"]);
  expect(hullsAfter({ select: null, removed: [], made: [] } as never)).toEqual([]);
});

describe("clicks on a step", () => {
  const shown = { asset: "a", steps: [{ select: ["x"], action: "Delete", error: null, made: ["m"], removed: ["x"] }, { select: null }] } as unknown as AssetView;

  it("show the asset after it, and the second opens it for editing", () => {
    useWorkspace.setState(initialWorkspace, true);
    clickAction(1, shown, 0)();
    expect(useWorkspace.getState().showing).toEqual({ kind: "steps", steps: 1 });
    expect([...useWorkspace.getState().selection]).toEqual(["m"]);
    expect(draft.draftStep).not.toHaveBeenCalled();
    clickAction(2, shown, 0)();
    clickAction(3, shown, 0)();
    expect(vi.mocked(draft.draftStep).mock.calls).toEqual([[0]]);
  });

  it("open a step that is not demonstrated here once", () => {
    clickAction(1, shown, 1)();
    clickAction(2, shown, 1)();
    expect(vi.mocked(draft.draftStep).mock.calls).toEqual([[1]]);
  });
});
