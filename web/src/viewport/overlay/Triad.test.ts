// Where the three axes are seen.
import { expect, it } from "vitest";
import { STANDARD, START } from "../camera/pose";
import { axesAsSeen } from "./Triad";

const round = (side: keyof typeof STANDARD, yUp = false) =>
  axesAsSeen({ ...START, ...STANDARD[side] }, yUp).map(({ x, y, near }) => [x, y, near].map((value) => Math.round(value) + 0));

it("from the front X goes right and Z up; from above X goes right and Y up; from the right Y goes right", () => {
  expect(round("front")).toEqual([[1, 0, 0], [0, 0, -1], [0, -1, 0]]);
  expect(round("top")).toEqual([[1, 0, 0], [0, -1, 0], [0, 0, 1]]);
  expect(round("right")).toEqual([[0, 0, 1], [1, 0, 0], [0, -1, 0]]);
});

it("where Y is up in the file, Y goes up from the front, and Z comes nearer", () => {
  expect(round("front", true)).toEqual([[1, 0, 0], [0, -1, 0], [0, 0, 1]]);
});
