
import { expect, test } from "vitest";
import type { Scene } from "../store/scenes";
import { distinctPlaces, fillOf } from "./hullColors";

const names = Array.from({ length: 40 }, (_, k) => `h${k}`);
const scene = (hulls: readonly { name: string; parent: string | null }[], contacts: [string, string][]) =>
  ({
    view: { hulls: names.map((name) => ({ name })), contacts: names.slice(1).map((name) => ["h0", name] as const) },
    hulls,
    contacts,
  }) as unknown as Scene;
const own = names.map((name) => ({ name, parent: null }));

test("neighbours differ in colour", () => {
  const places = distinctPlaces(scene(own, []));
  for (const name of names.slice(1)) expect(places.get(name)).not.toBe(places.get("h0"));
});

test("a hull keeps its colour through edits, and what is made of it takes it over", () => {
  const before = distinctPlaces(scene(own, []));
  const after = distinctPlaces(scene([...own.slice(3), { name: "made", parent: "h1" }], [["made", "h5"]]));
  expect(after.get("h5")).toBe(before.get("h5"));
  expect(after.get("made")).toBe(before.get("h1"));
});

test("what is made takes another colour where a neighbour has its parent's", () => {
  const before = distinctPlaces(scene(own, []));
  const twin = names.find((name) => name !== "h1" && before.get(name) === before.get("h1")) ?? "";
  const after = distinctPlaces(scene([...own, { name: "made", parent: "h1" }], [["made", twin]]));
  expect(after.get("made")).not.toBe(before.get("h1"));
});

test("labels that are given, guessed and unsure are told apart without colours", () => {
  expect((["given", "guessed", "unsure", null] as const).map((look) => fillOf({ look }))).toEqual(["solid", "dotted", "hatched", "solid"]);
});
