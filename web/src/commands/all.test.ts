// All commands together.
import { expect, test, vi } from "vitest";
import { all, commandFor } from "./all";
import type { Command } from "./command";

vi.mock("../store/edits", () => ({ undo: vi.fn(), redo: vi.fn(), perform: vi.fn() }));

const command = (id: string, enabled = true): Command => ({
  id,
  title: id,
  group: "Go",
  keys: ["A"],
  enabled: () => enabled,
  run: () => undefined,
});

test("of those that share a key the first that is enabled has it", () => {
  expect(commandFor("A", [command("one", false), command("two"), command("three")])?.id).toBe("two");
  expect(commandFor("B", [command("one")])).toBeUndefined();
});

test("no two commands have the same id", () => {
  const ids = all.map((one) => one.id);
  expect(ids.filter((id, k) => ids.indexOf(id) !== k)).toEqual([]);
});

test("every command is named in sentence case, without a full stop", () => {
  expect(all.filter((one) => !/^[A-Z]/.test(one.title) || one.title.endsWith(".")).map((one) => one.title)).toEqual([]);
});

test("no key is one that a browser keeps for itself", () => {
  const kept = /^Ctrl\+(Shift\+)?([1-9TNW]|Tab)$/;
  expect(all.flatMap((one) => one.keys).filter((key) => kept.test(key))).toEqual([]);
});
