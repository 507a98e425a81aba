
import { beforeEach, expect, test } from "vitest";
import type { Scene } from "./scenes";
import {
  forgetMissing,
  hide,
  invert,
  isolate,
  showAll,
  withConnected,
  withNeighbours,
  withSame,
} from "./selection";
import { initialWorkspace, useWorkspace } from "./workspace";

const scene = {
  hulls: [
    { name: "top", label: "panel", body: "base" },
    { name: "leg", label: "leg", body: "base" },
    { name: "foot", label: "leg", body: "base" },
    { name: "loose", label: null, body: "base" },
    { name: "other", label: null, body: "base" },
  ],
  contacts: [
    ["top", "leg"],
    ["leg", "foot"],
  ] as const,
};
const sorted = (names: Set<string>) => [...names].sort();

test("growing takes what touches the selection, and no further", () => {
  expect(sorted(withNeighbours(scene, new Set(["top"])))).toEqual(["leg", "top"]);
});

test("growing a hull that touches nothing changes nothing", () => {
  expect(sorted(withNeighbours(scene, new Set(["loose"])))).toEqual(["loose"]);
});

test("a component goes through all that hangs together", () => {
  expect(sorted(withConnected(scene, new Set(["foot"])))).toEqual(["foot", "leg", "top"]);
});

test("alike are hulls with the labels of the selection, or all without one", () => {
  expect(sorted(withSame("label", scene, new Set(["leg"])))).toEqual(["foot", "leg"]);
  expect(sorted(withSame("label", scene, new Set(["loose"])))).toEqual(["loose", "other"]);
  expect(withSame("body", scene, new Set(["loose"])).size).toBe(5);
});

test("inverting twice gives the selection back", () => {
  const once = invert(scene, new Set(["leg", "loose"]));
  expect(sorted(once)).toEqual(["foot", "other", "top"]);
  expect(sorted(invert(scene, once))).toEqual(["leg", "loose"]);
});

const sceneHiding = (...names: string[]) =>
  ({ asset: "a", showing: { kind: "source" }, hulls: names.map((name) => ({ name })) }) as unknown as Scene;
const state = () => ({ hidden: [...useWorkspace.getState().hidden].sort(), selection: [...useWorkspace.getState().selection].sort() });

beforeEach(() => useWorkspace.setState({ ...initialWorkspace, asset: "a", selection: new Set(["top", "leg"]) }, true));

test("what is hidden is no longer selected", () => {
  hide(["leg"]);
  expect(state()).toEqual({ hidden: ["leg"], selection: ["top"] });
});

test("isolating hides all others, and showing all brings them back", () => {
  isolate(sceneHiding("top", "leg", "foot"), new Set(["leg"]));
  expect(state()).toEqual({ hidden: ["foot", "top"], selection: ["leg"] });
  showAll();
  expect(state().hidden).toEqual([]);
});

test("hulls that are gone are forgotten", () => {
  hide(["foot"]);
  forgetMissing(sceneHiding("leg"));
  expect(state()).toEqual({ hidden: [], selection: ["leg"] });
});

test("a selection in a state that is on its way is kept", () => {
  useWorkspace.setState({ showing: { kind: "steps", steps: 2 } });
  forgetMissing(sceneHiding("leg"));
  expect(state().selection).toEqual(["leg", "top"]);
});
