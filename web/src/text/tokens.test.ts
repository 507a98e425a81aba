
import { describe, expect, it } from "vitest";
import { piecesOf, tokenize } from "./tokens";

const kinds = (text: string) => tokenize(text).flatMap(({ kind, text: word }) => (word.trim() ? [`${kind} ${word}`] : []));

describe("the words of a rule", () => {
  it("joined are the text again", () => {
    const text = 'Diff(Is("table top"), Geo(All,  -Z))   => Each(Replace("bar.obj", longest)) as rail';
    expect(tokenize(text).map((token) => token.text).join("")).toBe(text);
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
    const labels = tokenize('Union(Is("table top"), Is("Union")) => Merge as shelf').map((token) => token.label);
    expect(labels.filter((label) => label !== null)).toEqual(["table top", "Union", "shelf"]);
  });
});

const read = (line: string) => piecesOf(line).map(({ from, to, kind }) => `${kind} ${line.slice(from, to)}`);

describe("a line of a program", () => {
  it("has labels where it declares them", () => {
    expect(read('labels leg, "table top"')).toEqual(["keyword labels", "label leg", 'label "table top"']);
  });

  it("has directions and landmarks where it orients", () => {
    const pieces = ["keyword orient snap", "direction +Z", "operator Is", "label leg", "arrow ->", "operator All"];
    expect(read("orient snap +Z: Is(leg) -> All")).toEqual(pieces);
  });

  it("ends where its comment begins, which is not inside of quotes", () => {
    expect(read('Is("a # b") => Delete # so')).toEqual([
      "operator Is",
      'label "a # b"',
      "arrow =>",
      "action Delete",
      "comment # so",
    ]);
    expect(read('  # "quoted" words')).toEqual(['comment # "quoted" words']);
  });

  it("may be half written", () => {
    expect(read('Is("le')).toContain("operator Is");
    expect(read("")).toEqual([]);
  });
});
