// What the family shows, and in which order one walks through it.
import { expect, test } from "vitest";
import type { Card } from "../wire";
import type { Filters } from "./workspace";
import { countByFilter, filterAssets, matchesFilter, neighbour } from "./family";
import { sampleCard } from "./sample.test-help";

const plain = sampleCard({ hulls: 2, labels: [0, 1] });
const card = (change: Partial<Card>): Card => ({ ...plain, ...change });
const family = (...cards: Card[]) => Object.fromEntries(cards.map((one) => [one.asset, one]));
const all: Filters = { search: "", only: [], sort: "name" };
const project = {
  vocabulary: [
    { name: "door", text: "door", color: "#fff", used: 1, is_class: false },
    { name: "handle", text: "handle", color: "#000", used: 1, is_class: false },
  ],
};
const shown = (cards: Record<string, Card>, filters: Partial<Filters> = {}) =>
  filterAssets(cards, Object.keys(cards), { ...all, ...filters }, project);

test("names are sorted as people count", () => {
  expect(shown(family(card({ asset: "t10" }), card({ asset: "t2" }), card({ asset: "t1" })))).toEqual(["t1", "t2", "t10"]);
});

test("several filters show what fits any of them", () => {
  const cards = family(
    card({ asset: "bad", output: "failed" }),
    card({ asset: "wrong", review: "wrong" }),
    card({ asset: "fine" }),
  );
  expect(shown(cards, { only: ["failed", "wrong"] })).toEqual(["bad", "wrong"]);
});

test("the search finds names of assets and labels of their hulls; every word must be found", () => {
  const cards = family(card({ asset: "cabinet", labels: [0] }), card({ asset: "chest", labels: [1, -1] }));
  expect(shown(cards, { search: "HAND" })).toEqual(["chest"]);
  expect(shown(cards, { search: "cab door" })).toEqual(["cabinet"]);
  expect(shown(cards, { search: "cab handle" })).toEqual([]);
});

test("what is not read yet counts as fewest hulls", () => {
  const cards = family(card({ asset: "new", hulls: null, labels: [] }), card({ asset: "big", hulls: 9 }), card({ asset: "none", hulls: 0 }));
  expect(shown(cards, { sort: "hulls" })).toEqual(["big", "none", "new"]);
});

test("those that changed most come first, those without output last", () => {
  const cards = family(
    card({ asset: "a" }),
    card({ asset: "b", hulls: 9, after: 8 }),
    card({ asset: "c", hulls: 9, after: 1 }),
  );
  expect(shown(cards, { sort: "changed" })).toEqual(["c", "b", "a"]);
});

test("an asset that cannot be read counts as failed", () => {
  expect(matchesFilter(card({ error: "no such mesh" }), "failed")).toBe(true);
});

test("only outputs get stale", () => {
  expect(matchesFilter(card({ stale: ["program"] }), "stale")).toBe(false);
  expect(matchesFilter(card({ stale: ["program"], output: "edited" }), "stale")).toBe(true);
});

test("every filter counts its cards", () => {
  const counts = countByFilter(family(card({ asset: "a", labels: [-1] }), card({ asset: "b", confidence: [49], demonstrated: true })));
  expect(counts).toMatchObject({ unlabelled: 1, unsure: 1, demonstrated: 1, flagged: 0 });
});

test("walking goes round the end, both ways", () => {
  expect(neighbour(["a", "b", "c"], [], "c", 1)).toBe("a");
  expect(neighbour(["a", "b", "c"], [], "a", -1)).toBe("c");
});

test("from an asset that is not shown one comes to the first that is, or the last", () => {
  expect(neighbour(["a", "b"], ["x", "a", "b"], "x", 1)).toBe("a");
  expect(neighbour(["a", "b"], ["x", "a", "b"], "x", -1)).toBe("b");
});

test("walking stops only where it is wanted, and nowhere if nothing is", () => {
  const order = ["a", "b", "c", "d"];
  expect(neighbour(order, order, "a", 1, (asset) => asset === "d")).toBe("d");
  expect(neighbour(order, order, "d", 1, (asset) => asset === "d")).toBe(null);
  expect(neighbour(order, order, "a", 1, () => false)).toBe(null);
});
