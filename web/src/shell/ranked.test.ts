// Finding commands and assets by some of their letters.
import { expect, test } from "vitest";
import { ranked } from "./ranked";

const lines = ["Previous asset", "Undo", "Next asset", "assets/chair.urdf", "Select all"].map((title) => ({ title, aside: "Go" }));
const titles = (search: string) => ranked(lines, search).map((one) => one.title);

test("without a word all are there, in their order", () => {
  expect(titles("  ")).toEqual(lines.map((one) => one.title));
});

test("what begins with the word comes before what has it inside", () => {
  expect(titles("asset")).toEqual(["assets/chair.urdf", "Previous asset", "Next asset"]);
  expect(titles("n")[0]).toBe("Next asset");
});

test("every word must be there, and none is taken for a pattern", () => {
  expect(titles("asset next")).toEqual(["Next asset"]);
  expect(titles("(.*")).toEqual([]);
});

test("the group is found, too", () => {
  expect(titles("go undo")).toEqual(["Undo"]);
});
