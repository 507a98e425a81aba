// Which assets come side by side: by key, by clicks on cards, page by page.
import { beforeEach, expect, it } from "vitest";
import { commandFor } from "../commands/list";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { extendSheet, openBeside, toggleOnSheet, toggleSheet } from "./sheet";
import { initialWorkspace, openAsset, openStage, useWorkspace } from "./workspace";

const order = Array.from({ length: 20 }, (_, k) => `a${k}`);
const sheet = () => useWorkspace.getState().sheet;

beforeEach(() => {
  const cards = Object.fromEntries(order.map((asset) => [asset, sampleCard({ asset, hulls: asset === "a3" ? 0 : 4 })]));
  useProject.setState({ ...emptyProject, cards, order }, true);
  useWorkspace.setState({ ...initialWorkspace, asset: "a5" }, true);
});

it("a key shows the page of the open asset, without those that have no hulls, and the open one alone again", () => {
  commandFor("W")?.run();
  expect(sheet()).toEqual(["a0", "a1", "a2", "a4", "a5", "a6", "a7", "a8"]);
  expect(useWorkspace.getState().asset).toBe("a5");
  commandFor("W")?.run();
  expect([sheet(), useWorkspace.getState().asset]).toEqual([[], "a5"]);
});

it("Tab goes on to as many others, to the end and round it, and back", () => {
  toggleSheet();
  openBeside(1);
  expect([sheet()[0], sheet().length, useWorkspace.getState().asset]).toEqual(["a9", 8, "a9"]);
  openBeside(1);
  expect(sheet()).toEqual(["a17", "a18", "a19"]);
  openBeside(1);
  expect(sheet()[0]).toBe("a0");
  openBeside(-1);
  expect(sheet().at(-1)).toBe("a19");
});

it("cards come and go one by one, or up to one, in the order of the family", () => {
  toggleOnSheet("a7");
  toggleOnSheet("a2");
  expect(sheet()).toEqual(["a2", "a5", "a7"]);
  toggleOnSheet("a5");
  expect([sheet(), useWorkspace.getState().asset]).toEqual([["a2", "a7"], "a2"]);
  extendSheet("a5");
  expect(sheet()).toEqual(["a2", "a4", "a5"]);
});

it("Escape leaves it once nothing is selected", () => {
  toggleSheet();
  useWorkspace.setState({ selection: new Set(["x · a5"]) });
  commandFor("Escape")?.run();
  expect([sheet().length, useWorkspace.getState().selection.size]).toEqual([8, 0]);
  commandFor("Escape")?.run();
  expect(sheet()).toEqual([]);
});

it("another asset or another stage ends it", () => {
  toggleSheet();
  openAsset("a5");
  expect(sheet()).toEqual([]);
  toggleSheet();
  openStage("learn");
  expect(sheet()).toEqual([]);
});
