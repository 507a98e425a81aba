
import { describe, expect, it } from "vitest";
import type { ActionForm, Argument, StepView } from "../wire";
import { defaultArguments, draftText, goesWith, missingArgument, parseAction, withArgument } from "./actions";
import { openPlaces, placeFor, placeOf } from "./steps";
import type { Draft } from "./workspace";

const argument = (name: string, kind: Argument["kind"], choices: string[] = [], required = true): Argument => ({
  name,
  kind,
  wants: name,
  choices,
  required,
});
const form = (name: string, ...args: Argument[]): ActionForm => ({
  name,
  summary: "",
  usage: "",
  makes: true,
  arguments: args,
});
const replace = form(
  "Replace",
  argument("geometry", "shape", ["box", "cylinder", "capsule", "sphere"]),
  argument("fit", "words", ["native", "tight", "inscribed", "volume", "longest"], false),
  argument("axis", "words", ["X", "Y", "Z"], false),
  argument("radius", "option", ["radius"], false),
);
const add = form(
  "Add",
  argument("direction", "words", ["+X", "-X", "+Y", "-Y", "+Z", "-Z"]),
  argument("template", "file"),
  argument("keep", "flag", ["keep"], false),
);
const scale = form("Scale", argument("axis", "words", ["all", "X", "Y", "Z"]), argument("factor", "factor"));
const shrink = form("Shrink", argument("distance", "length"));
const forms = [form("Delete"), form("Merge"), replace, add, scale, shrink];
const draft = (more: Partial<Draft>): Draft => ({
  action: "Delete",
  arguments: {},
  each: false,
  label: "",
  editing: null,
  ...more,
});

describe("the text of a step, read as a draft and written again", () => {
  it.each([
    "Delete",
    "Merge as leg",
    "Each(Merge)",
    "Replace(box)",
    "Replace(capsule, tight)",
    "Each(Replace(sphere, native))",
    'Each(Replace("tray, big.obj", longest)) as "table top"',
    'Add(-Z, "a \\"b\\".obj", keep)',
    'Add(+X, "knob.obj") as knob',
    "Scale(Z, 0.5)",
    "Replace(sphere, radius = 0.05)",
    "Each(Replace(cylinder, native, Z))",
    "Replace(capsule, X, radius = 0.01) as grip",
    "Shrink(0.002)",
  ])("is the same: %s", (text) => {
    const parts = parseAction(text, forms);
    const order = forms.find(({ name }) => name === parts?.action)?.arguments ?? [];
    expect(parts && draftText(draft(parts), order)).toBe(text);
  });

  it("has its options in any order, and in that of the form when written again", () => {
    const parts = parseAction("Replace(capsule, radius=0.01, X)", forms);
    expect(parts && draftText(draft(parts), replace.arguments)).toBe("Replace(capsule, X, radius = 0.01)");
  });

  it.each(["Replace(sphere, radius)", "Replace(sphere, radius = 0)", "Replace(box, X, X)", "Shrink(0)", "", "Explode", "Replace(pyramid)", "Scale(Z, 0)", "Scale(0.5, Z)", "Each("])("is no draft: %j", (text) => {
    expect(parseAction(text, forms)).toBeNull();
  });
});

describe("arguments", () => {
  it("begin with the first choice, and with a template where there is one", () => {
    expect(defaultArguments(replace, [])).toEqual({ geometry: "box" });
    expect(defaultArguments(add, ["tray.obj"])).toEqual({ direction: "+X", template: "tray.obj" });
  });

  it("are missing where they are required and empty, or no factor", () => {
    expect(missingArgument(draft({ arguments: defaultArguments(add, []) }), add)?.name).toBe("template");
    expect(missingArgument(draft({ arguments: { axis: "Z", factor: -1 } }), scale)?.name).toBe("factor");
    expect(missingArgument(draft({ arguments: { axis: "Z", factor: 2 } }), scale)).toBeUndefined();
  });

  it("that no longer go with a shape are left out", () => {
    expect(withArgument({ geometry: "box", fit: "tight" }, "geometry", "sphere")).toEqual({ geometry: "sphere" });
    expect(withArgument({ geometry: "box", fit: "tight" }, "geometry", "capsule")).toEqual({
      geometry: "capsule",
      fit: "tight",
    });
    expect(withArgument({ geometry: "capsule", fit: "native" }, "geometry", "box")).toEqual({ geometry: "box" });
    expect(goesWith("native", { geometry: "sphere" })).toBe(true);
    expect(goesWith("native", { geometry: "bar.obj" })).toBe(false);
    expect(goesWith("longest", { geometry: "bar.obj" })).toBe(true);
    expect(goesWith("radius", { geometry: "box" })).toBe(false);
    expect(withArgument({ geometry: "capsule", fit: "tight" }, "radius", 0.1)).toEqual({ geometry: "capsule", radius: 0.1 });
    expect(withArgument({ geometry: "capsule", axis: "X" }, "fit", "tight")).toEqual({ geometry: "capsule", fit: "tight" });
    expect(withArgument({ geometry: "sphere", radius: 0.1 }, "geometry", "box")).toEqual({ geometry: "box" });
  });
});

describe("the rule that a draft is for", () => {
  const rule = (number: number, action: string) => ({ rule: number, action, shown: ["a"], nothing: [] });
  const rules = [rule(1, "Delete"), rule(2, "Each(Merge)"), rule(3, "Delete")];
  const step = (select: string[] | null): StepView => ({
    rule: 1,
    select,
    action: "Delete",
    error: null,
    made: [],
    removed: [],
  });

  it("is the first open one with such an action", () => {
    expect(placeFor("Delete", rules, { steps: [] }, forms)).toBe(0);
    expect(placeFor("Delete", rules, { steps: [step(["x"])] }, forms)).toBe(2);
    expect(placeFor("Merge", rules, { steps: [step([])] }, forms)).toBe(1);
    expect(placeFor("Scale", rules, { steps: [] }, forms)).toBeNull();
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
