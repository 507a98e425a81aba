import { describe, expect, it } from "vitest";
import { tokens } from "./tokens";

const kinds = (text: string) => tokens(text).flatMap(({ kind, text: word }) => (word.trim() ? [`${kind} ${word}`] : []));

describe("the words of a rule", () => {
  it("joined are the text again", () => {
    const text = 'Diff(Is("table top"), Geo(All,  -Z))   => Each(Replace("bar.obj", longest)) as rail';
    expect(tokens(text).map((token) => token.text).join("")).toBe(text);
  });

  it("are told apart", () => {
    expect(kinds("Geo(Is(leg), -Z) => Scale(Z, 0.5)").filter((word) => !word.startsWith("plain"))).toEqual([
      "operator Geo",
      "operator Is",
      "label leg",
      "direction -Z",
      "arrow =>",
      "action Scale",
      "word Z",
      "number 0.5",
    ]);
  });

  it("name labels without their quotes, also those that are operators' names and those of what is made", () => {
    const labels = tokens('Union(Is("table top"), Is("Union")) => Merge as shelf').map((token) => token.label);
    expect(labels.filter((label) => label !== null)).toEqual(["table top", "Union", "shelf"]);
  });
});
