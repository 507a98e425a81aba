// Words on cards.
import { expect, test } from "vitest";
import type { Card } from "../wire";
import { badgesOf, cardText, fitBadges } from "./cardText";

const card: Card = {
  asset: "a.urdf",
  hulls: 3,
  labels: [0, -1, 0],
  confidence: [30, 101],
  demonstrated: true,
  output: "edited",
  after: 2,
  after_labels: [],
  stale: ["program"],
  error: null,
  flags: [],
  review: null,
  excluded: null,
  note: null,
  manual_edits: 1,
  sources: 0,
  prepared: [],
  picture: null,
  edited_picture: null,
  check: null,
  faults: null,
  goals: [],
};

test("every way an asset stands has a badge of its own", () => {
  expect(badgesOf(card).map((badge) => badge.name)).toEqual([
    "stale",
    "demonstrated",
    "corrected",
    "edited",
    "unsure",
    "unlabelled",
  ]);
});

test("why a result is wrong or flagged is said", () => {
  const [first, second] = badgesOf({ ...card, review: "wrong", note: "leg too short", flags: ["open mesh"] });
  expect([first?.text, second?.text]).toEqual(["Wrong: leg too short", "Flagged: open mesh"]);
});

test("a screen reader hears name, hulls before and after, and how it stands", () => {
  expect(cardText(card)).toMatch(/^a\.urdf; 3 hulls, 2 after; Not up to date: program; Demonstrated/);
  expect(cardText({ ...card, hulls: null, error: "no mesh file" })).toContain("no mesh file");
});

test("of signs that do not fit, those stay that matter most, and at least one", () => {
  const all = badgesOf(card);
  expect([500, 40, 0].map((room) => fitBadges(all, room).map(({ name }) => name))).toEqual([all.map(({ name }) => name), ["stale", "demonstrated"], ["stale"]]);
});

test("that no hull has a label is no sign while none of the family has one", () => {
  expect(badgesOf(card, "", true).map(({ name }) => name)).not.toContain("unlabelled");
});
