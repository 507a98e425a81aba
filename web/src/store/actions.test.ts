import { describe, expect, it } from "vitest";
import type { ActionCall, ActionForm, StepView } from "../wire";
import { defaultArguments, goesWith, isSameAction, missingArgument, withArgument } from "./actions";
import { sampleAction, sampleArgument, sampleCall, sampleForm } from "./sample.test-help";
import { openPlaces, placeFor, placeOf } from "./steps";

const replace = sampleForm(
  "Replace",
  [
    sampleArgument("geometry", "shape", ["box", "capsule", "sphere"]),
    sampleArgument("fit", "words", ["native", "tight", "longest"], false),
    sampleArgument("axis", "words", ["X", "Y", "Z"], false),
    sampleArgument("radius", "option", ["radius"], false),
  ],
  { clashes: [
    pair("geometry", "box", "fit", "native"),
    pair("geometry", "sphere", "fit", "tight"),
    pair("geometry", null, "fit", "native"),
    pair("geometry", "box", "radius", null),
    pair("fit", "tight", "axis", "X"),
    pair("fit", "tight", "radius", null),
  ] },
);
const add = sampleForm("Add", [
  sampleArgument("direction", "words", ["+X", "-X"]),
  sampleArgument("template", "file"),
  sampleArgument("keep", "flag", ["keep"], false),
]);
const scale = sampleForm("Scale", [sampleArgument("axis", "words", ["all", "X", "Y", "Z"]), sampleArgument("factor", "factor")]);

/** Two values that do not go together; null for any that is none of the choices. */
function pair(name: string, value: string | null, other: string, otherValue: string | null): ActionForm["clashes"][number] {
  return [{ name, value }, { name: other, value: otherValue }];
}
const given = (more: Required<ActionCall>["arguments"]) => ({ ...sampleCall(), arguments: more });

describe("arguments", () => {
  it("begin with the first choice, and with a template where there is one", () => {
    expect(defaultArguments(replace, [])).toEqual({ geometry: "box" });
    expect(defaultArguments(add, ["tray.obj"])).toEqual({ direction: "+X", template: "tray.obj" });
  });

  it("are missing where they are required and empty, or no factor", () => {
    expect(missingArgument(given(defaultArguments(add, [])), add)?.name).toBe("template");
    expect(missingArgument(given({ axis: "Z", factor: -1 }), scale)?.name).toBe("factor");
    expect(missingArgument(given({ axis: "Z", factor: 2 }), scale)).toBeUndefined();
    expect(missingArgument(given({ geometry: "sphere", radius: NaN }), replace)?.name).toBe("radius");
  });

  it("that clash with the one that is chosen are left out, and those that say nothing", () => {
    expect(withArgument({ geometry: "box", fit: "tight" }, "geometry", "sphere", replace)).toEqual({ geometry: "sphere" });
    expect(withArgument({ geometry: "box", fit: "tight" }, "geometry", "capsule", replace)).toEqual({ geometry: "capsule", fit: "tight" });
    expect(withArgument({ geometry: "capsule", fit: "tight" }, "radius", 0.1, replace)).toEqual({ geometry: "capsule", radius: 0.1 });
    expect(withArgument({ geometry: "capsule", axis: "X" }, "fit", "tight", replace)).toEqual({ geometry: "capsule", fit: "tight" });
    expect(withArgument({ geometry: "sphere", radius: 0.1 }, "geometry", "box", replace)).toEqual({ geometry: "box" });
    expect(withArgument({ geometry: "box", fit: "tight" }, "fit", "", replace)).toEqual({ geometry: "box" });
  });

  it("are offered where they go with the shape", () => {
    expect(goesWith("fit", "native", { geometry: "sphere" }, replace)).toBe(true);
    expect(goesWith("fit", "native", { geometry: "bar.obj" }, replace)).toBe(false);
    expect(goesWith("fit", "longest", { geometry: "bar.obj" }, replace)).toBe(true);
    expect(goesWith("radius", 1, { geometry: "box" }, replace)).toBe(false);
  });
});

it("actions are the same whatever the order of their arguments, and not with another label", () => {
  const one = given({ axis: "Z", factor: 2 });
  expect(isSameAction(one, given({ factor: 2, axis: "Z" }))).toBe(true);
  expect(isSameAction(one, { ...one, label: "leg" })).toBe(false);
});

describe("the rule that a draft is for", () => {
  const rule = (number: number, action: string) => ({ rule: number, action: sampleAction(action), shown: ["a"], nothing: [] });
  const rules = [rule(1, "Delete"), rule(2, "Merge"), rule(3, "Delete")];
  const step = (select: string[] | null): StepView => ({
    select,
    action: sampleAction(),
    error: null,
    made: [],
    removed: [],
  });

  it("is the first open one with such an action", () => {
    expect(placeFor("Delete", rules, { steps: [] })).toBe(0);
    expect(placeFor("Delete", rules, { steps: [step(["x"])] })).toBe(2);
    expect(placeFor("Merge", rules, { steps: [step([])] })).toBe(1);
    expect(placeFor("Scale", rules, { steps: [] })).toBeNull();
  });

  it("is open where nothing is said, not where nothing is selected", () => {
    expect(openPlaces(rules, { steps: [step([]), step(null)] })).toEqual([1, 2]);
  });

  it("is a new one after all others where none was chosen", () => {
    expect(placeOf({ editing: null }, 3, 1)).toBe(3);
    expect(placeOf({ editing: null }, 0, 0)).toBe(0);
    expect(placeOf({ editing: 1 }, 3, 1)).toBe(1);
  });
});
