
import { expect, test } from "vitest";
import type { SceneHull } from "../store/scenes";
import { keysBetween, linesOf, matchesSearch, namesOf, nextOrder, rowsOf } from "./rows";

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
const hullsOf = (rows: { hull: SceneHull }[]) => rows.map((row) => row.hull.name);

test("without a column rows stand in the order of the file", () => {
  expect(hullsOf(rowsOf(hulls, [], "", { column: null, down: false }))).toEqual(["part_10", "part_9", "part_2"]);
});

test("names are sorted by the numbers in them", () => {
  expect(hullsOf(rowsOf(hulls, [], "", { column: "name", down: false }))).toEqual(["part_2", "part_9", "part_10"]);
});

test("hulls without a label come after those with one", () => {
  expect(hullsOf(rowsOf(hulls, [], "", { column: "label", down: false }))).toEqual(["part_2", "part_10", "part_9"]);
});

test("neighbours are counted on both sides of a contact", () => {
  const rows = rowsOf(hulls, [["part_9", "part_2"], ["part_9", "part_10"]], "", { column: "neighbours", down: true });
  expect(rows.map((row) => row.neighbours)).toEqual([2, 1, 1]);
});

test("a search finds words in name, label and body, all of them", () => {
  expect(matchesSearch("LEG part", "part_10", "leg")).toBe(true);
  expect(matchesSearch("leg drawer", "part_10", "leg")).toBe(false);
  expect(hullsOf(rowsOf(hulls, [], "drawer", { column: null, down: false }))).toEqual(["part_2"]);
});

test("clicking a head three times comes back to the order of the file", () => {
  const once = nextOrder({ column: null, down: false }, "volume");
  const twice = nextOrder(once, "volume");
  expect([once.down, twice.down, nextOrder(twice, "volume").column]).toEqual([false, true, null]);
});

test("a range runs either way, and is one row where it begins nowhere", () => {
  expect(keysBetween(["a", "b", "c"], "c", "b")).toEqual(["b", "c"]);
  expect(keysBetween(["a", "b", "c"], "gone", "b")).toEqual(["b"]);
});

test("hulls stand below their bodies, which search and order leave together; a closed one stands for its hulls", () => {
  const some = [hull("door_2", "handle", 1), hull("door_1", "door", 2)].map((one) => ({ ...one, body: "door" }));
  const all = [...hulls, ...some];
  const lines = (search: string, closed: string[] = [], bodies = all.map(({ body }) => body)) =>
    linesOf(rowsOf(all, [], search, { column: "name", down: false }), bodies, new Set(closed));
  const keys = (found: ReturnType<typeof lines>) => found.map(({ key }) => key);
  expect(keys(lines(""))).toEqual(["body base/", "part_2", "part_9", "part_10", "body door/", "door_1", "door_2"]);
  expect(keys(lines("", ["base"]))).toEqual(["body base/", "body door/", "door_1", "door_2"]);
  expect(lines("", ["base"]).map(namesOf)[0]).toEqual(["part_2", "part_9", "part_10"]);
  expect(keys(lines("handle"))).toEqual(["body door/", "door_2"]);
  expect(keys(linesOf(rowsOf(hulls, [], "", { column: null, down: false }), ["base", "base", "base"], new Set()))).toEqual(["part_10", "part_9", "part_2"]);
});
