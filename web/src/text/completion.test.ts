import { describe, expect, it } from "vitest";
import { sampleArgument as argument, sampleForm } from "../store/sample.test-help";
import type { Argument } from "../wire";
import { wordBefore, type Context, openCall, suggestions } from "./completion";

const operand = (name: string, kind: Argument["kind"], choices: string[] = []) => argument(name, kind, choices);
const operator = (name: string, base: boolean, ...given: Argument[]) => ({
  name,
  usage: given.length > 0 ? `${name}(${given.map((one) => one.name).join(", ")})` : name,
  summary: "",
  base,
  arguments: given,
});
const context: Context = {
  language: {
    goals: [],
    actions: [
      sampleForm("Delete"),
      sampleForm("Replace", [
        argument("geometry", "shape", ["box", "sphere"]),
        argument("fit", "words", ["tight"], false),
        argument("radius", "option", ["radius"], false),
      ]),
    ],
    operators: [
      operator("All", true),
      operator("Is", true, operand("label", "label")),
      operator("Attach", false, operand("selected", "base"), operand("anchor", "base")),
      operator("Geo", false, operand("base", "base"), operand("direction", "words", ["+X", "-X"])),
      operator("Smaller", false, operand("base", "base"), operand("share", "share")),
      operator("Union", false, operand("left", "extractor"), operand("right", "extractor")),
    ],
    directions: ["+X", "-X"],
  },
  labels: ["leg", '"table top"'],
  templates: ["tray.obj"],
};
const after = (line: string, bare = false) => suggestions(line, context, bare).map(({ label }) => label);

describe("what may follow in a program", () => {
  it.each([
    ["", ["All", "Is", "Attach", "Geo", "Smaller", "Union"]],
    ["Smaller(", ["All", "Is"]],
    ["Smaller(All, ", []],
    ["Union(All, ", ["All", "Is", "Attach", "Geo", "Smaller", "Union"]],
    ["Is(", ["leg", '"table top"']],
    ["Is(le", ["leg", '"table top"']],
    ["Attach(Is(leg), ", ["All", "Is"]],
    ["Geo(Is(leg), -", ["+X", "-X"]],
    ["Is(leg) => ", ["Delete", "Replace", "Each"]],
    ["Is(leg) => Each(Re", ["Delete", "Replace"]],
    ["Is(leg) => Replace(", ["box", "sphere", '"tray.obj"']],
    ["Is(leg) => Each(Replace(box, ", ["tight", "radius = "]],
    ["Is(leg) => Replace(box, tight, ", ["tight", "radius = "]],
    ["Is(leg) => Replace(box) as ", ["leg", '"table top"']],
    ["labels leg", []],
    ["orient ", ["+X", "-X", "All", "Is"]],
  ])("after %j is %j", (line, expected) => expect(after(line)).toEqual(expected));

  it("is an extractor only, where only an extractor is typed", () => {
    expect(after("Is(leg) => ", true)).toEqual(["All", "Is", "Attach", "Geo", "Smaller", "Union"]);
  });

  it("takes the place of the word that was begun", () => {
    expect(wordBefore("Is(le")).toBe("le");
    expect(wordBefore('Is("table t')).toBe('"table t');
    expect(wordBefore("Geo(All, -")).toBe("-");
    expect(wordBefore("Is(leg) ")).toBe("");
  });

  it("knows the call around it", () => {
    expect(openCall("Attach(Is(a), ")).toEqual({ name: "Attach", commas: 1 });
    expect(openCall("Is(a)")).toBeNull();
  });
});
