import { describe, expect, it } from "vitest";
import { amountText } from "./steps";
import { ownPositions } from "./highlight";
import { previewText } from "./preview";

describe("what an action would do, in words", () => {
  it.each([
    [4, { made: [], removed: ["a", "b", "c", "d"] }, "4 hulls go"],
    [1, { made: [], removed: ["a"] }, "1 hull goes"],
    [2, { made: ["k~1"], removed: [] }, "1 hull is added"],
    [3, { made: ["a~1"], removed: ["a", "b", "c"] }, "3 hulls → 1"],
    [1, { made: [], removed: [] }, "Nothing changes"],
  ])("of %i hulls: %j", (selected, header, words) => expect(previewText(selected, header)).toBe(words));
});

it("says how much a step takes", () => {
  expect([{ select: ["a", "b"] }, { select: [] }, { select: null }, undefined].map(amountText)).toEqual([
    "×2",
    "nothing here",
    "open",
    "open",
  ]);
});

it("finds the hulls that made ones are named after, each once", () => {
  const own = [{ name: "a" }, { name: "b" }, { name: "c~1" }];
  expect(ownPositions(["b", "a~1~2", "a", "c~1", "gone"], own)).toEqual([1, 0, 2]);
});
