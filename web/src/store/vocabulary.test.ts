import { expect, it } from "vitest";
import { moved, withAdded } from "./vocabulary";

it("adds several labels at once, each only once", () => {
  expect(withAdded(["leg"], " door,drawer ,, leg,table   top,door")).toEqual(["leg", "door", "drawer", "table top"]);
  expect(withAdded(["leg"], " , ")).toEqual(["leg"]);
});

it("moves a line up, down, and no further than the ends", () => {
  expect(moved(["a", "b", "c"], 2, 0)).toEqual(["c", "a", "b"]);
  expect(moved(["a", "b", "c"], 0, 1)).toEqual(["b", "a", "c"]);
  expect(moved(["a", "b", "c"], 0, 9)).toEqual(["b", "c", "a"]);
});
