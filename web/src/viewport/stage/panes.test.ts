import { expect, test } from "vitest";
import { paneAt, panesOf } from "./panes";

test("without anything to compare with there is one pane", () => {
  expect(panesOf("slider", false, 0.5, 800).map((pane) => pane.which)).toEqual(["shown"]);
});

test("with a line both panes show the same picture, clipped at it", () => {
  const panes = panesOf("slider", true, 0.25, 800);
  expect(panes.map((pane) => [pane.x, pane.width, ...pane.clip])).toEqual([
    [0, 800, 0, 200],
    [0, 800, 200, 800],
  ]);
  expect(paneAt(panes, 199).which).toBe("before");
  expect(paneAt(panes, 200).which).toBe("shown");
});

test("side by side both are equally wide and what is shown is on the right", () => {
  const [before, shown] = panesOf("side", true, 0.25, 801);
  expect([before?.width, shown?.width, shown?.x, shown?.clip[1]]).toEqual([400, 400, 401, 801]);
});

test("a pixel beyond the rim belongs to the last pane", () => {
  expect(paneAt(panesOf("side", true, 0.5, 800), 900).which).toBe("shown");
});
