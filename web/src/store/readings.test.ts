
import { describe, expect, it } from "vitest";
import { chooseSeparating } from "./readings";

const own = { x: [1], y: [2], z: [3] };

describe("the assets that tell a reading from its rivals", () => {
  it("is one, where it rules out all of them", () => {
    const rivals = [
      { belief: 0.6, assets: { x: [1], y: [5], z: [3] } },
      { belief: 0.2, assets: { x: [9], y: [2, 5], z: [3] } },
    ];
    expect(chooseSeparating(own, rivals)).toEqual(["y"]);
  });

  it("are several, the one first that rules out the most belief", () => {
    const rivals = [
      { belief: 0.1, assets: { x: [9], y: [2], z: [3] } },
      { belief: 0.6, assets: { x: [1], y: [2], z: [] } },
    ];
    expect(chooseSeparating(own, rivals)).toEqual(["z", "x"]);
  });

  it("leaves a rival that does the same everywhere, in whatever order", () => {
    const both = { x: [1, 2] };
    expect(chooseSeparating(both, [{ belief: 0.9, assets: { x: [2, 1] } }])).toEqual([]);
  });

  it("rules out a rival that is hardly believable, too", () => {
    expect(chooseSeparating(own, [{ belief: 0, assets: { x: [1], y: [], z: [3] } }])).toEqual(["y"]);
  });

  it("says no more than it may", () => {
    const rivals = ["x", "y", "z"].map((asset) => ({ belief: 0.3, assets: { ...own, [asset]: [7] } }));
    expect(chooseSeparating(own, rivals, 2)).toHaveLength(2);
  });
});
