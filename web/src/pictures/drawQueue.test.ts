// Which pictures are drawn in a frame.
import { beforeEach, expect, it, vi } from "vitest";
import { drawSoon } from "./drawQueue";

let now = 0;
let frames: (() => void)[] = [];
const runFrame = () => frames.splice(0).forEach((frame) => frame());

beforeEach(() => {
  frames = [];
  vi.stubGlobal("requestAnimationFrame", (frame: () => void) => frames.push(frame));
  vi.spyOn(performance, "now").mockImplementation(() => now);
});

it("draws many pictures over several frames, in the order in which they were asked for", () => {
  const drawn: number[] = [];
  for (let k = 0; k < 5; k++) drawSoon({}, () => { drawn.push(k); now += 4; });
  expect(drawn).toEqual([]);
  runFrame();
  expect(drawn).toEqual([0, 1]);
  runFrame();
  runFrame();
  expect(drawn).toEqual([0, 1, 2, 3, 4]);
  expect(frames).toEqual([]);
});

it("draws one that takes long all the same, and what is asked for later", () => {
  const drawn: string[] = [];
  drawSoon({}, () => { drawn.push("long"); now += 50; });
  runFrame();
  drawSoon({}, () => drawn.push("later"));
  runFrame();
  expect(drawn).toEqual(["long", "later"]);
});

it("draws the last picture of an owner only, and none that was taken back", () => {
  const drawn: string[] = [];
  const owner = {};
  const dropOld = drawSoon(owner, () => drawn.push("old"));
  drawSoon(owner, () => drawn.push("new"));
  dropOld();
  drawSoon({}, () => drawn.push("gone"))();
  runFrame();
  expect(drawn).toEqual(["new"]);
});
