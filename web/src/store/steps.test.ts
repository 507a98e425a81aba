import { describe, expect, it } from "vitest";
import { draftText, labelText } from "./actions";
import { emptyProject, useProject } from "./project";
import { actionOf, withoutStep, withStep } from "./steps";
import type { Draft } from "./workspace";

const draft = (more: Partial<Draft>): Draft => ({
  action: "Delete",
  arguments: {},
  each: false,
  label: "",
  editing: null,
  ...more,
});
const replace = [
  { name: "geometry", kind: "shape" },
  { name: "fit", kind: "words" },
];

describe("the text of a draft", () => {
  it("is the bare name of an action without arguments", () => {
    expect(draftText(draft({}), [])).toBe("Delete");
  });

  it("writes primitives bare and files in quotes", () => {
    expect(draftText(draft({ action: "Replace", arguments: { geometry: "capsule" } }), replace)).toBe("Replace(capsule)");
    const file = draft({ action: "Replace", arguments: { geometry: 'a "b".obj', fit: "longest" } });
    expect(draftText(file, replace)).toBe('Replace("a \\"b\\".obj", longest)');
  });

  it("wraps each and names what is made", () => {
    const text = draftText(draft({ action: "Merge", each: true, label: "left leg" }), []);
    expect(text).toBe('Each(Merge) as "left leg"');
    expect(draftText(draft({ action: "Merge", label: "leg" }), [])).toBe("Merge as leg");
  });

  it("writes a flag only where it is set", () => {
    const add = [
      { name: "direction", kind: "words" },
      { name: "template", kind: "file" },
      { name: "keep", kind: "flag" },
    ];
    const given = { direction: "+X", template: "knob.obj" };
    expect(draftText(draft({ action: "Add", arguments: { ...given, keep: false } }), add)).toBe('Add(+X, "knob.obj")');
    expect(draftText(draft({ action: "Add", arguments: { ...given, keep: true } }), add)).toBe('Add(+X, "knob.obj", keep)');
  });
});

describe("changes to steps", () => {
  const step = { select: ["a"], action: "Delete" };

  it("leaves the rules before open, with what other assets do there", () => {
    const rules = [{ rule: 1, action: "Each(Merge)", shown: [], nothing: [] }];
    useProject.setState({ project: { ...emptyProject.project, rules } });
    expect(withStep(2, step)([])).toEqual([{ select: null, action: "Each(Merge)" }, { select: null, action: "Delete" }, step]);
    expect(actionOf(5)).toBe("Delete");
  });

  it("puts a step in the place of the one before", () => {
    expect(withStep(0, step)([{ select: [], action: "Merge" }])).toEqual([step]);
  });

  it("takes the last step away, and leaves another one open", () => {
    const other = { select: ["b"], action: "Merge" };
    expect(withoutStep(1)([step, other])).toEqual([step]);
    expect(withoutStep(0)([step, other])).toEqual([{ select: null, action: "Delete" }, other]);
  });
});

it("quotes labels that are no single word", () => {
  expect(labelText("leg")).toBe("leg");
  expect(labelText("left leg")).toBe('"left leg"');
  expect(labelText("2nd")).toBe('"2nd"');
});
