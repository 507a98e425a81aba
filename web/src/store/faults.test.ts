import { describe, expect, it } from "vitest";
import { badges } from "../family/words";
import type { Fault } from "../wire";
import { filtered } from "./family";
import { byEdit, faultsOf, foundText, ruleTitle, unchecked, weightOf } from "./faults";
import { sampleCard } from "./sample.test-help";

const fault = (rule: string, change: Partial<Fault> = {}): Fault => ({ rule, severity: "warning", engine: null, new: true, ...change });
const old = fault("shape-gap", { new: false });
const limit = fault("physx-gpu-vertices", { engine: "physx-gpu" });
const broken = fault("physics-refused", { severity: "error" });

const card = (asset: string, faults: Fault[] | null) => sampleCard({ asset, check: "c", faults });

describe("what checks found", () => {
  it("counts the limits of the chosen engine only", () => {
    expect(faultsOf(card("a", [old, limit]), "")).toEqual([old]);
    expect(faultsOf(card("a", [old, limit]), "physx-gpu")).toEqual([old, limit]);
    expect(faultsOf(card("a", [old, limit]), "unity")).toEqual([old]);
    expect(faultsOf(card("a", null), "")).toEqual([]);
  });

  it("tells what came with the edit from what was there before", () => {
    expect(byEdit([old, limit])).toBe(1);
    expect(foundText([old, limit])).toBe("2 findings of the checks, 1 by the edit");
    expect(foundText([old])).toBe("1 finding of the checks, all as before the edit");
    expect(foundText([limit])).toBe("1 finding of the checks, by the edit");
  });

  it("has words for a rule without the part that it belongs to", () => {
    expect([limit, old, fault("fit-out"), fault("clearance-closed")].map(ruleTitle)).toEqual(["Vertices", "Gap", "Sticks out", "Closed"]);
  });

  it("weighs errors most, then what came with the edit, and what was not checked least", () => {
    const rows = [card("a", null), card("b", []), card("c", [old, old]), card("d", [limit]), card("e", [fault("fit-out")]), card("f", [broken])];
    const cards = Object.fromEntries(rows.map((one) => [one.asset, one]));
    const order = rows.map((one) => one.asset);
    const by = (engine: string) => filtered(cards, order, { search: "", only: [], sort: "findings" }, { vocabulary: [] }, engine);
    expect(by("")).toEqual(["f", "e", "c", "b", "d", "a"]);
    expect(by("physx-gpu")).toEqual(["f", "d", "e", "c", "b", "a"]);
    expect(rows.map((one) => weightOf(one, ""))).toEqual([-1, 0, 2, 0, 10, 10000]);
    expect(filtered(cards, order, { search: "", only: ["findings"], sort: "name" }, { vocabulary: [] })).toEqual(["c", "e", "f"]);
  });

  it("is a sign on the card, quieter where the edit brought none of it", () => {
    const sign = (faults: Fault[]) => badges(card("a", faults), "").find(({ name }) => name === "findings");
    expect(sign([])).toBeUndefined();
    expect(sign([limit])).toBeUndefined();
    expect(sign([old])).toMatchObject({ count: 1, old: true });
    expect(sign([old, broken])).toMatchObject({ count: 2, old: false });
  });

  it("counts outputs that were not checked, not assets without one", () => {
    expect(unchecked([card("a", null), card("b", []), sampleCard()])).toBe(1);
  });
});
