// Painting with look-alikes: what is outlined under the brush, and what a click then paints.
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { followBrush, hullsToPaint, useAlike } from "./alike";
import { useScenes } from "./scenes";
import { hover, initialWorkspace, setBrush, useWorkspace } from "./workspace";

const hulls = ["x", "y", "z", "w"].map((name) => ({ name, label: null, source: name === "z" ? "user" : "file" }));
let stop: () => void;

beforeEach(() => {
  vi.useFakeTimers({ toFake: ["setTimeout", "clearTimeout", "performance"] });
  useWorkspace.setState({ ...initialWorkspace, asset: "a", brush: "leg", hidden: new Set(["w"]) }, true);
  useScenes.setState({ scene: { asset: "a", hulls, view: { hulls } } as never });
  const found = [{ asset: "a", hulls: hulls.map(({ name }) => name), positions: [0, 1, 2, 3] }];
  vi.spyOn(api, "similar").mockResolvedValue({ found, step: 0, more: true, unread: [], passed_over: 0 });
  stop = followBrush();
});
afterEach(() => {
  stop();
  vi.useRealTimers();
  vi.restoreAllMocks();
});

const point = async (name: string | null) => {
  hover(name);
  await vi.advanceTimersByTimeAsync(100);
};

it("outlines look-alikes in sight that no person labelled, and a click paints them once they were seen", async () => {
  await point("x");
  expect(useAlike.getState().others).toEqual(["y"]);
  expect(hullsToPaint("x", false)).toEqual(["x"]);
  await vi.advanceTimersByTimeAsync(200);
  expect(hullsToPaint("x", false)).toEqual(["x", "y"]);
  expect(hullsToPaint("x", true)).toEqual(["x"]);
  expect(hullsToPaint("y", false)).toEqual(["y"]);
});

it("outlines none for another hull, without a label in hand, or when the pointer was gone before the answer", async () => {
  await point("x");
  hover("y");
  expect(useAlike.getState().others).toEqual([]);
  setBrush("");
  await point("x");
  expect(api.similar).toHaveBeenCalledTimes(1);
  setBrush("leg");
  vi.mocked(api.similar).mockImplementation(async () => (hover(null), { found: [], step: 0, more: false, unread: [], passed_over: 0 }));
  await point("y");
  expect(useAlike.getState().hull).toBeNull();
});
