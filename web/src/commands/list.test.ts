// All commands together.
import { expect, test, vi } from "vitest";
import { type Command, needs } from "./command";
import { commandFor, listCommands, foldCommands, paletteLines, rankLines } from "./list";

vi.mock("../store/edits", () => ({ undo: vi.fn(), redo: vi.fn(), perform: vi.fn() }));

const command = (id: string, enabled = true): Command => ({
  id,
  title: id,
  group: "Go",
  keys: ["A"],
  enabled: needs("no", () => enabled),
  run: () => undefined,
});

test("of those that share a key the first that is enabled has it", () => {
  expect(commandFor("A", [command("one", false), command("two"), command("three")])?.id).toBe("two");
  expect(commandFor("B", [command("one")])).toBeUndefined();
});

test("no two commands have the same id", () => {
  const ids = listCommands().map((one) => one.id);
  expect(ids.filter((id, k) => ids.indexOf(id) !== k)).toEqual([]);
});

test("every command is named in sentence case, without a full stop", () => {
  expect(listCommands().filter((one) => !/^[A-Z]/.test(one.title) || one.title.endsWith(".")).map((one) => one.title)).toEqual([]);
});

test("no key is one that a browser keeps for itself", () => {
  const kept = /^Ctrl\+(Shift\+)?([1-9TNW]|Tab)$/;
  expect(listCommands().flatMap((one) => one.keys).filter((key) => kept.test(key))).toEqual([]);
});

const line = (title: string, ...keys: string[]) => ({ id: title, title, keys });

test("commands that differ in a number only share a line", () => {
  const lines = foldCommands([line("All", "A"), line("Label 1: red", "1"), line("Label 2: red", "2"), line("Label 3: red", "3")]);
  expect(lines.map(({ title, keys }) => [title, ...keys])).toEqual([
    ["All", "A"],
    ["Label 1 to 3: red", "1", "…", "3"],
  ]);
});

test("numbered commands with words of their own stay apart", () => {
  const lines = [line("Stage 1: Label", "Alt+1"), line("Stage 2: Learn", "Alt+2"), line("Undo"), line("Undo")];
  expect(foldCommands(lines)).toEqual(lines);
});

const lines = ["Previous asset", "Undo", "Next asset", "assets/chair.urdf", "Select all"].map((title) => ({ title, aside: "Go" }));
const titles = (search: string) => rankLines(lines, search).map((one) => one.title);

test("without a word all are there, in their order", () => {
  expect(titles("  ")).toEqual(lines.map((one) => one.title));
});

test("what begins with the word comes before what has it inside", () => {
  expect(titles("asset")).toEqual(["assets/chair.urdf", "Previous asset", "Next asset"]);
  expect(titles("n")[0]).toBe("Next asset");
});

test("every word must be there, and none is taken for a pattern", () => {
  expect(titles("asset next")).toEqual(["Next asset"]);
  expect(titles("(.*")).toEqual([]);
});

test("the list of commands has every command; one that cannot run now, and no other, has a reason", () => {
  const shown = new Map(paletteLines().map((one) => [one.id, one]));
  const others = listCommands().filter(({ id }) => id !== "palette");
  expect(others.filter(({ id }) => !shown.has(id)).map(({ id }) => id)).toEqual([]);
  const wrong = others.filter(({ id, enabled }) => {
    const reason = shown.get(id)?.reason;
    return enabled && !enabled() ? !/^[A-Z].*\.$/.test(reason ?? "") : reason !== null;
  });
  expect(wrong.map(({ id }) => id)).toEqual([]);
  expect([shown.get("undo")?.reason, shown.get("apply")?.reason]).toEqual(["Nothing to undo.", "There are no assets yet."]);
});

test.each([
  ["export", "export"], ["split", "cut"], ["cut", "cut"], ["unit", "unit"], ["import", "add"], ["add assets", "add"], ["decompose", "decompose"],
  ["undo", "undo"], ["rename", "vocabulary"], ["save", "save"], ["orient", "landmark"], ["up", "landmark"], ["settings", "unit"], ["history", "history"],
])("%s is found by its common word", (word, id) => {
  expect(rankLines(paletteLines(), word).map((one) => one.id).slice(0, 4)).toContain(id);
});

test("the group is found, too", () => {
  expect(titles("go undo")).toEqual(["Undo"]);
});
