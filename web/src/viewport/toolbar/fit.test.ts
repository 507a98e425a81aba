// What stays in a row that has not room for all.
import { describe, expect, it } from "vitest";
import { fittingParts, GAP, MORE } from "./fit";

const parts = [
  { id: "a", keep: 3 },
  { id: "b", keep: 1 },
  { id: "c", keep: 2 },
];
const widths = new Map([["a", 100], ["b", 50], ["c", 80]]);
const ALL = 100 + 50 + 80 + 2 * GAP;
const fit = (room: number, known: ReadonlyMap<string, number> = widths) => [...fittingParts(parts, known, room)].sort();

describe("a row", () => {
  it("has all where all fit, to the pixel, and no button then", () => {
    expect(fit(ALL)).toEqual(["a", "b", "c"]);
    expect(fit(ALL - 1)).toEqual(["a", "c"]);
  });

  it("keeps what is most wanted, with room for the button", () => {
    expect(fit(100 + 80 + 2 * GAP + MORE)).toEqual(["a", "c"]);
    expect(fit(100 + 80 + 2 * GAP + MORE - 1)).toEqual(["a"]);
    expect(fit(10)).toEqual([]);
  });

  it.each(Array.from({ length: 30 }, (_, k) => 10 * k))("is never wider than its room, and never loses a part by getting wider: %i", (room) => {
    const kept = fit(room);
    const width = kept.reduce((sum, id) => sum + (widths.get(id) ?? 0) + GAP, kept.length < parts.length ? MORE : -GAP);
    if (kept.length) expect(width).toBeLessThanOrEqual(room);
    expect(kept.every((id) => fit(room + 10).includes(id))).toBe(true);
  });

  it("gives what is not there no room", () => {
    expect(fit(100 + 50 + GAP, new Map([["a", 100], ["b", 50], ["c", 0]]))).toEqual(["a", "b", "c"]);
  });
});
