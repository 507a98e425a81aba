// Keys on a step, and the hulls that are selected when it is shown.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import * as draft from "../store/draft";
import * as edits from "../store/edits";
import * as store from "../store/steps";
import type { AssetView } from "../wire";
import { hullsAfter, keyAction } from "./StepChip";

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
