import { describe, expect, it } from "vitest";
import type { Card } from "../wire";
import { labelProgress, nextUnsure } from "./unsure";

const card = (asset: string, labels: number[], unsure: number[]): Card => ({
  asset,
  hulls: labels.length,
  labels,
  unsure,
  demonstrated: false,
  output: "none",
  after: null,
  after_labels: [],
  stale: [],
  error: null,
  flags: [],
  review: null,
  note: null,
  corrections: 0,
  sources: 0,
  prepared: [],
  picture: null,
  edited_picture: null,
});
const cards = { a: card("a", [0, -1], []), b: card("b", [0, 1, 1], [2, 0]), c: card("c", [1], [0]) };
const order = ["a", "b", "c"];

describe("the queue of unsure hulls", () => {
  it("goes from hull to hull, asset to asset, and round", () => {
    const walked = [null, { asset: "b", position: 0 }, { asset: "b", position: 2 }, { asset: "c", position: 0 }].map(
      (from) => nextUnsure(cards, order, from),
    );
    expect(walked).toEqual([
      { asset: "b", position: 0 },
      { asset: "b", position: 2 },
      { asset: "c", position: 0 },
      { asset: "b", position: 0 },
    ]);
  });

  it("begins on the asset in hand where nothing is selected there", () => {
    expect(nextUnsure(cards, order, { asset: "c", position: -1 })).toEqual({ asset: "c", position: 0 });
  });

  it("is empty where all are sure", () => {
    expect(nextUnsure({ a: cards.a }, ["a"], null)).toBeNull();
  });
});

it("counts hulls with and without a label", () => {
  expect(labelProgress(cards)).toEqual({ hulls: 6, labelled: 5, unsure: 3, assets: 2 });
});
