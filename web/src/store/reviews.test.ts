import { describe, expect, it } from "vitest";
import type { Card, EditHeader, HullView } from "../wire";
import { alarmsOf, listAcceptable, nextInQueue, listOutdated, listExportable, groupCards, groupOf, isSignedOff, numbersOf, reviewQueue, solidText, staleText, verdictOf } from "./reviews";
import { sampleCard, sampleRow } from "./sample.test-help";

const card = (asset: string, more: Partial<Card> = {}) =>
  sampleCard({ asset, output: "edited", after: 2, ...more });
const edited = (more: Partial<EditHeader> = {}): EditHeader => ({
  rows: [],
  hulls: [],
  made: [],
  removed: [],
  changed: [],
  note: null,
  trace: [],
  findings: [],
  flags: [],
  volume: [2, 1],
  contacts: [],
  ...more,
});
const family = [
  card("a", { review: "accepted" }),
  card("b"),
  card("c", { output: "failed", error: "no leg" }),
  card("d", { review: "wrong" }),
  card("e", { flags: ["an edit by hand was left out"] }),
  card("f", { stale: ["program"], review: "accepted" }),
  card("g", { output: "none", after: null }),
  card("h", { output: "none", after: null, hulls: null, error: "cannot be read" }),
];

describe("results in groups", () => {
  it("puts each card into one", () => {
    const rows = groupCards(family);
    expect(Object.fromEntries(Object.entries(rows).map(([group, cards]) => [group, cards.map((one) => one.asset)]))).toEqual({
      failed: ["c"],
      wrong: ["d"],
      flagged: ["e"],
      stale: ["f"],
      open: ["b"],
      accepted: ["a"],
      none: ["g", "h"],
      excluded: [],
    });
  });

  it("takes an accepted result for accepted although something was left out", () => {
    expect(groupOf(card("x", { flags: ["left out"], review: "accepted" }))).toBe("accepted");
  });

  it("keeps what is excluded apart, whatever became of it", () => {
    expect(groupOf(card("x", { output: "failed", excluded: "not solved" }))).toBe("excluded");
  });

  it("lets a failure wait for the next run once what it failed on has changed", () => {
    expect(groupOf(card("x", { output: "failed", stale: ["labels"] }))).toBe("stale");
  });
});

describe("the queue of what wants a look", () => {
  const order = family.map((one) => one.asset);

  it("has what failed first, then what is wrong or flagged, then what nobody reviewed", () => {
    expect(reviewQueue(family)).toEqual(["c", "d", "e", "b"]);
    const held = Object.fromEntries(["f", "g"].map((asset) => [asset, sampleRow({ asset, state: "needs review" })]));
    expect(reviewQueue(family, held)).toEqual(["c", "d", "e", "b", "f", "g"]);
  });

  it("goes round", () => {
    expect(nextInQueue(["c", "d", "b"], order, "d")).toBe("b");
    expect(nextInQueue(["c", "d", "b"], order, "b")).toBe("c");
  });

  it("goes on behind an asset that is not in it", () => {
    expect(nextInQueue(["c", "d", "b"], order, "a")).toBe("c");
    expect(nextInQueue(["c", "d", "b"], order, "h")).toBe("c");
    expect(nextInQueue(["c", "d", "b"], order, null)).toBe("c");
  });

  it("has no next but itself", () => {
    expect(nextInQueue(["b"], order, "b")).toBeNull();
    expect(nextInQueue([], order, "b")).toBeNull();
  });
});

describe("what can be done with all", () => {
  it("accepts only what is up to date, unflagged and not reviewed", () => {
    expect(listAcceptable(family)).toEqual(["b"]);
  });

  it("counts outputs that are missing or old, but not assets that cannot be read", () => {
    expect(listOutdated(family)).toEqual(["f", "g"]);
  });

  it("exports what is written, or only what is signed off and up to date", () => {
    const { signed: accepted, all } = listExportable(family, {});
    expect([accepted.length, all.length]).toEqual([1, 5]);
    const sure = Object.fromEntries(family.map(({ asset }) => [asset, sampleRow({ asset })]));
    const signed = family.filter((one) => isSignedOff(one, sure[one.asset]));
    expect(signed.every(({ stale, review }) => !stale.length && review !== "wrong")).toBe(true);
    expect(listExportable(family, sure).signed).toEqual(signed);
    expect(signed.length).toBeGreaterThan(1);
  });

  it("are called solid where an engine makes one hull of a file of several", () => {
    const known = { merged_files: ["stl"], merged_by: ["a", "b", "c"], engines: { a: "MuJoCo", b: "PhysX on the CPU", c: "PhysX on the GPU" } };
    const text = (after: number, ...assets: string[]) => solidText(assets.map((asset) => card(asset, { after })), known);
    expect([text(1, "a.stl"), text(2, "a.urdf"), text(2)]).toEqual([null, null, null]);
    expect(text(2, "a.urdf", "b.STL")).toBe("1 of these 2 outputs is a mesh file of several hulls, of which MuJoCo and PhysX make one solid hull.");
    expect(text(3, "a.stl", "b.stl")).toBe("These 2 outputs are mesh files of several hulls, of which MuJoCo and PhysX make one solid hull.");
  });
});

describe("numbers about a result", () => {
  it("sums vertices and faces before and after", () => {
    const hull = (vertices: number, faces: number) => ({ vertices, faces }) as HullView;
    const numbers = numbersOf([hull(8, 12), hull(4, 4)], edited({ hulls: [hull(8, 12)] }));
    expect(numbers).toEqual({ hulls: [2, 1], vertices: [12, 8], faces: [16, 12], volume: [2, 1] });
  });

  it("is as legal as its worst finding", () => {
    const finding = (severity: "error" | "warning" | "note") => ({ severity, text: "", hull: null });
    expect(verdictOf(edited({ findings: [finding("note")] }))).toBe("legal");
    expect(verdictOf(edited({ findings: [finding("note"), finding("warning")] }))).toBe("doubtful");
    expect(verdictOf(edited({ findings: [finding("warning"), finding("error")] }))).toBe("illegal");
  });

  it("says why it is stale, also for a reason it does not know", () => {
    expect(staleText(["labels", "weather"])).toBe("its labels changed, weather changed");
  });
});

it("marks the numbers that the alarms of an asset are about", () => {
  const row = (text: string, kind: "alarm" | "label" = "alarm") => ({ reasons: [{ kind, text, hulls: [], rule: null, share: 0 }] });
  const block = "nearly one solid block: 94% of the free space is filled";
  expect(alarmsOf(row(block))).toEqual({ hulls: null, volume: block });
  expect(alarmsOf(row("volume +762%, the family +3% to +9%")).volume).toContain("+762%");
  expect(alarmsOf(row("number of hulls -90%, the family -40%"))).toEqual({ hulls: "number of hulls -90%, the family -40%", volume: null });
  expect(alarmsOf(row("no hull is left"))).toEqual({ hulls: "no hull is left", volume: "no hull is left" });
  expect(alarmsOf(row("volume of convex_1 is doubtful", "label"))).toEqual({ hulls: null, volume: null });
  expect(alarmsOf(undefined)).toEqual({ hulls: null, volume: null });
});
