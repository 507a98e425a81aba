
import { expect, test } from "vitest";
import type { SceneHull } from "../store/scenes";
import { matchesSearch, namesBetween, nextOrder, rowsOf } from "./rows";

const hull = (name: string, label: string | null, volume: number): SceneHull => ({
  name,
  label,
  volume,
  body: "base",
  confidence: null,
  source: null, look: null,
  vertices: 8,
  faces: 12,
  primitive: null,
  parent: null,
  made: false,
  shape: { positions: new Float32Array(), index: new Uint32Array() },
});
const hulls = [hull("part_10", "leg", 3), hull("part_9", null, 1), hull("part_2", "drawer", 2)];
const namesOf = (rows: { hull: SceneHull }[]) => rows.map((row) => row.hull.name);

test("without a column rows stand in the order of the file", () => {
  expect(namesOf(rowsOf(hulls, [], "", { column: null, down: false }))).toEqual(["part_10", "part_9", "part_2"]);
});

test("names are sorted by the numbers in them", () => {
  expect(namesOf(rowsOf(hulls, [], "", { column: "name", down: false }))).toEqual(["part_2", "part_9", "part_10"]);
});

test("hulls without a label come after those with one", () => {
  expect(namesOf(rowsOf(hulls, [], "", { column: "label", down: false }))).toEqual(["part_2", "part_10", "part_9"]);
});

test("neighbours are counted on both sides of a contact", () => {
  const rows = rowsOf(hulls, [["part_9", "part_2"], ["part_9", "part_10"]], "", { column: "neighbours", down: true });
  expect(rows.map((row) => row.neighbours)).toEqual([2, 1, 1]);
});

test("a search finds words in name, label and body, all of them", () => {
  expect(matchesSearch("LEG part", "part_10", "leg")).toBe(true);
  expect(matchesSearch("leg drawer", "part_10", "leg")).toBe(false);
  expect(namesOf(rowsOf(hulls, [], "drawer", { column: null, down: false }))).toEqual(["part_2"]);
});

test("clicking a head three times comes back to the order of the file", () => {
  const once = nextOrder({ column: null, down: false }, "volume");
  const twice = nextOrder(once, "volume");
  expect([once.down, twice.down, nextOrder(twice, "volume").column]).toEqual([false, true, null]);
});

test("a range runs either way, and is one row where it begins nowhere", () => {
  expect(namesBetween(["a", "b", "c"], "c", "b")).toEqual(["b", "c"]);
  expect(namesBetween(["a", "b", "c"], "gone", "b")).toEqual(["b"]);
});
