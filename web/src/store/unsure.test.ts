import { describe, expect, it } from "vitest";
import { givenLabels, labelProgress, nextUnsure } from "./unsure";
import { sampleCard } from "./sample.test-help";

const card = (asset: string, labels: number[], unsure: number[]) =>
  sampleCard({ asset, hulls: labels.length, labels, unsure });
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

  it("goes back, and round the other way", () => {
    const walked = [{ asset: "c", position: 0 }, { asset: "b", position: 2 }, { asset: "b", position: 0 }, null].map(
      (from) => nextUnsure(cards, order, from, -1),
    );
    expect(walked).toEqual([
      { asset: "b", position: 2 },
      { asset: "b", position: 0 },
      { asset: "c", position: 0 },
      { asset: "c", position: 0 },
    ]);
  });

  it("goes back to the asset before where nothing is selected", () => {
    expect(nextUnsure(cards, order, { asset: "c", position: -1 }, -1)).toEqual({ asset: "b", position: 2 });
  });

  it("is empty where all are sure", () => {
    expect(nextUnsure({ a: cards.a }, ["a"], null)).toBeNull();
  });
});

it("counts hulls with and without a label", () => {
  expect(labelProgress(cards)).toEqual({ hulls: 6, labelled: 5, unsure: 3, assets: 2 });
});

it("counts hulls that people and files labelled", () => {
  const given = { a: { ...cards.a, given: 1 }, b: { ...cards.b, given: 3 }, c: cards.c };
  expect(givenLabels(given)).toEqual({ hulls: 6, given: 4, assets: 2 });
});
