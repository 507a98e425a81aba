import { expect, test } from "vitest";
import { alike, component, grown, inverted } from "./neighbours";

const scene = {
  hulls: [
    { name: "top", label: "panel" },
    { name: "leg", label: "leg" },
    { name: "foot", label: "leg" },
    { name: "loose", label: null },
    { name: "other", label: null },
  ],
  contacts: [
    ["top", "leg"],
    ["leg", "foot"],
  ] as const,
};
const sorted = (names: Set<string>) => [...names].sort();

test("growing takes what touches the selection, and no further", () => {
  expect(sorted(grown(scene, new Set(["top"])))).toEqual(["leg", "top"]);
});

test("growing a hull that touches nothing changes nothing", () => {
  expect(sorted(grown(scene, new Set(["loose"])))).toEqual(["loose"]);
});

test("a component goes through all that hangs together", () => {
  expect(sorted(component(scene, new Set(["foot"])))).toEqual(["foot", "leg", "top"]);
});

test("alike are hulls with the labels of the selection, or all without one", () => {
  expect(sorted(alike(scene, new Set(["leg"])))).toEqual(["foot", "leg"]);
  expect(sorted(alike(scene, new Set(["loose"])))).toEqual(["loose", "other"]);
});

test("inverting twice gives the selection back", () => {
  const once = inverted(scene, new Set(["leg", "loose"]));
  expect(sorted(once)).toEqual(["foot", "other", "top"]);
  expect(sorted(inverted(scene, once))).toEqual(["leg", "loose"]);
});
