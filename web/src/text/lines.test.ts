import { describe, expect, it } from "vitest";
import { piecesOf } from "./lines";

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
