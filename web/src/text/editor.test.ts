import { CompletionContext } from "@codemirror/autocomplete";
import { EditorState, Text } from "@codemirror/state";
import { beforeEach, describe, expect, it } from "vitest";
import { emptyProject, useProject } from "../store/project";
import { sampleArgument, sampleForm } from "../store/sample.test-help";
import type { LanguageView } from "../wire";
import { complete, diagnostic } from "./editor";

const language: LanguageView = {
  goals: [],
  actions: [sampleForm("Delete"), sampleForm("Replace", [sampleArgument("geometry", "shape", ["box", "capsule"])])],
  operators: [
    { name: "All", usage: "All", summary: "", base: true, arguments: [] },
    {
      name: "Is",
      usage: "Is(label)",
      summary: "",
      base: true,
      arguments: [sampleArgument("label", "label")],
    },
  ],
  directions: ["+X", "-Z"],
};

/** What is offered at the end of a text, after a key or on demand. */
function offered(text: string, { explicit = false, bare = false } = {}) {
  const state = EditorState.create({ doc: text });
  return complete(new CompletionContext(state, text.length, explicit), bare);
}

const labels = (text: string, how = {}) => offered(text, how)?.options.map((option) => option.label) ?? null;

beforeEach(() => {
  const vocabulary = ["leg", "table top"].map((name) => ({ name, text: name === "leg" ? name : JSON.stringify(name), color: "#000000", used: 0, is_class: false }));
  useProject.setState({ ...emptyProject, language, project: { ...emptyProject.project, vocabulary, templates: ["tray.obj"] } }, true);
});

describe("completion", () => {
  it("offers what may stand where a word begins", () => {
    expect(labels("A")).toEqual(["All", "Is"]);
    expect(labels("Is(")).toEqual(["leg", '"table top"']);
    expect(labels("Is(leg) => ")).toEqual(["Delete", "Replace", "Each"]);
    expect(labels("Is(leg) => Replace(")).toEqual(["box", "capsule", '"tray.obj"']);
  });

  it("offers nothing on an empty line, unless it is asked for", () => {
    expect(labels("")).toBeNull();
    expect(labels("", { explicit: true })).toEqual(["All", "Is"]);
  });

  it("offers nothing for a word that is complete", () => {
    expect(labels("Is(leg")).toBeNull();
    expect(labels("Is(leg) => Delete")).toBeNull();
  });

  it("offers calls that still want their brackets, also where their name is complete", () => {
    const found = offered("Is(leg) => Replace");
    expect(found?.options.find(({ label }) => label === "Replace")?.apply).toBeTypeOf("function");
    expect(found?.options.find(({ label }) => label === "Delete")?.apply).toBeUndefined();
  });

  it("takes the place of the word that was begun", () => {
    expect(offered("Is(le")?.from).toBe(3);
    expect(offered('Is("table t')?.from).toBe(3);
    expect(offered("first line\nIs(le")?.from).toBe(14);
  });

  it("goes on while the same word is typed, and ends with it", () => {
    const going = offered("Is(l")?.validFor as (text: string) => boolean;
    expect(going("le")).toBe(true);
    expect(going("leg")).toBe(false);
    expect(going("le)")).toBe(false);
  });

  it("offers no actions in an extractor alone", () => {
    expect(labels("Is(leg) => D", { bare: true })).toEqual(["All", "Is"]);
  });
});

describe("an error", () => {
  const doc = Text.of(["labels leg", "Is(leg) => Fly", ""]);
  const marked = (line: number, column: number) => {
    const { from, to } = diagnostic(doc, { line, column, message: "" });
    return doc.sliceString(from, to);
  };

  it("is underlined to the end of its word", () => {
    expect(marked(2, 12)).toBe("Fly");
    expect(marked(2, 4)).toBe("leg");
    expect(marked(2, 3)).toBe("(");
  });

  it("at the end of a line is underlined with the sign before it", () => {
    expect(marked(2, 15)).toBe("y");
  });

  it("stays in the text, wherever it is said to be", () => {
    expect(marked(99, 1)).toBe("");
    expect(marked(0, 1)).toBe("labels");
    expect(marked(1, 99)).toBe("g");
  });

  it("has the message of the server", () => {
    const { message, severity } = diagnostic(doc, { line: 1, column: 1, message: "no such action" });
    expect([message, severity]).toEqual(["no such action", "error"]);
  });
});
