import { beforeEach, expect, test } from "vitest";
import { initialDesk, useDesk } from "./desk";
import { forgetGone, hide, isolate, showAll } from "./hiding";
import type { Scene } from "./scenes";

const scene = (...names: string[]) =>
  ({ asset: "a", showing: { kind: "source" }, hulls: names.map((name) => ({ name })) }) as unknown as Scene;
const state = () => ({ hidden: [...useDesk.getState().hidden].sort(), selection: [...useDesk.getState().selection].sort() });

beforeEach(() => useDesk.setState({ ...initialDesk, asset: "a", selection: new Set(["top", "leg"]) }, true));

test("what is hidden is no longer selected", () => {
  hide(["leg"]);
  expect(state()).toEqual({ hidden: ["leg"], selection: ["top"] });
});

test("isolating hides all others, and showing all brings them back", () => {
  isolate(scene("top", "leg", "foot"), new Set(["leg"]));
  expect(state()).toEqual({ hidden: ["foot", "top"], selection: ["leg"] });
  showAll();
  expect(state().hidden).toEqual([]);
});

test("hulls that are gone are forgotten", () => {
  hide(["foot"]);
  forgetGone(scene("leg"));
  expect(state()).toEqual({ hidden: [], selection: ["leg"] });
});

test("a selection in a state that is on its way is kept", () => {
  useDesk.setState({ showing: { kind: "steps", steps: 2 } });
  forgetGone(scene("leg"));
  expect(state().selection).toEqual(["leg", "top"]);
});
