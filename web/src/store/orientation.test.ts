import { describe, expect, it } from "vitest";
import { pairFromClicks, withoutPair, withPair } from "./orientation";

const up = { axis: "+Z", start: "leg", end: "panel" } as const;
const front = { axis: "+X", start: null, end: "front, door" } as const;

describe("a clicked direction", () => {
  it("takes the place of the one along the same axis", () => {
    const before = { snap: true, pairs: [up, front] };
    const down = { axis: "-Z", start: "a", end: "b" } as const;
    expect(withPair(before, down)).toEqual({ snap: true, pairs: [down, front] });
  });

  it("comes second, and never third", () => {
    expect(withPair({ snap: false, pairs: [up] }, front).pairs).toEqual([up, front]);
    const side = { ...front, axis: "+Y" } as const;
    expect(withPair({ snap: false, pairs: [up, front] }, side).pairs).toEqual([up, side]);
  });

  it("is set by two different labels", () => {
    expect(pairFromClicks("+Z", "leg", "table top")).toEqual({ axis: "+Z", start: "leg", end: "table top" });
    expect(pairFromClicks("+Z", "leg", null)).toMatch(/label it first/);
    expect(pairFromClicks("+Z", "leg", "leg")).toMatch(/two different labels/);
  });

  it("can be taken away", () => {
    expect(withoutPair({ snap: true, pairs: [up] }, 0).pairs).toEqual([]);
  });
});
