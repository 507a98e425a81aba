// Lines of the help.
import { expect, test } from "vitest";
import { folded } from "./folded";

const line = (title: string, ...keys: string[]) => ({ id: title, title, keys });

test("commands that differ in a number only share a line", () => {
  const lines = folded([line("All", "A"), line("Label 1: red", "1"), line("Label 2: red", "2"), line("Label 3: red", "3")]);
  expect(lines.map(({ title, keys }) => [title, ...keys])).toEqual([
    ["All", "A"],
    ["Label 1 to 3: red", "1", "…", "3"],
  ]);
});

test("numbered commands with words of their own stay apart", () => {
  const lines = [line("Stage 1: Label", "Alt+1"), line("Stage 2: Learn", "Alt+2"), line("Undo"), line("Undo")];
  expect(folded(lines)).toEqual(lines);
});
