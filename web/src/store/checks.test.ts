
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { commandFor } from "../commands/list";
import { reviewCommands } from "../commands/review";
import { badgesOf } from "../family/cardText";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { CheckResult, Fault, Job } from "../wire";
import {
  countByEdit,
  countUnchecked,
  DELAY,
  faultsOf,
  findingsText,
  measure,
  type Part,
  partKey,
  PARTS,
  retryPart,
  ruleTitle,
  selectInOutput,
  showPictures,
  useChecks,
  weightOf,
} from "./checks";
import { filterAssets } from "./family";
import { whyNotCheck } from "./jobs";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { initialWorkspace, openStage, useWorkspace } from "./workspace";

const checked = (part: Part): CheckResult => ({ part, figures: [], findings: [], gone: 0, notes: [], cell: null, pictured: false });
const problem = { message: "the process that worked on this died", where: null, remedy: null, conflict: false };
const kinds = () => PARTS.map((part) => useChecks.getState().parts[partKey("a", "1", part)]?.kind);

beforeEach(() => {
  vi.useFakeTimers();
  useChecks.setState({ parts: {}, tries: 0, pictured: [] });
  useWorkspace.setState(initialWorkspace, true);
  useProject.setState(emptyProject, true);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

it("measures nothing of what one only passes by", async () => {
  const asked = vi.spyOn(api, "checked");
  measure("a", "1")();
  await vi.advanceTimersByTimeAsync(DELAY * 2);
  expect(asked).not.toHaveBeenCalled();
});

it("measures one part after the other, each once", async () => {
  const asked = vi.spyOn(api, "checked").mockImplementation((_, part) => Promise.resolve(checked(part)));
  const stop = measure("a", "1");
  await vi.advanceTimersByTimeAsync(DELAY);
  stop();
  expect(asked.mock.calls.map(([, part]) => part)).toEqual(PARTS);
  expect(kinds()).toEqual(PARTS.map(() => "there"));
  measure("a", "1");
  await vi.advanceTimersByTimeAsync(DELAY);
  expect(asked).toHaveBeenCalledTimes(PARTS.length);
  measure("a", "2");
  await vi.advanceTimersByTimeAsync(DELAY);
  expect(asked).toHaveBeenCalledTimes(2 * PARTS.length);
});

it("stops when one goes on, and begins again where it stopped", async () => {
  vi.spyOn(api, "checked").mockImplementation((_, part, stop) =>
    part === "physics"
      ? new Promise((_, refuse) => stop.addEventListener("abort", () => refuse(new DOMException("", "AbortError"))))
      : Promise.resolve(checked(part)),
  );
  const stop = measure("a", "1");
  await vi.advanceTimersByTimeAsync(DELAY);
  expect(kinds()).toEqual(["there", "coming", undefined, undefined]);
  stop();
  await vi.advanceTimersByTimeAsync(DELAY);
  expect(kinds()).toEqual(["there", undefined, undefined, undefined]);
});

it("says what could not be measured, goes on with the rest, and tries again when asked to", async () => {
  const asked = vi.spyOn(api, "checked").mockImplementation((_, part) =>
    part === "physics" ? Promise.reject(new ServerProblem(problem, 400)) : Promise.resolve(checked(part)),
  );
  measure("a", "1");
  await vi.advanceTimersByTimeAsync(DELAY);
  expect(kinds()).toEqual(["there", "problem", "there", "there"]);
  asked.mockImplementation((_, part) => Promise.resolve(checked(part)));
  retryPart("a", "1", "physics");
  expect(useChecks.getState().tries).toBe(1);
  measure("a", "1");
  await vi.advanceTimersByTimeAsync(DELAY);
  expect(kinds()).toEqual(PARTS.map(() => "there"));
});

it("shows the output where hulls of it are selected", () => {
  useWorkspace.setState({ asset: "a", stage: "review", showing: { kind: "result", of: "program" } });
  selectInOutput("a", ["h"]);
  expect(useWorkspace.getState().showing).toEqual({ kind: "result", of: "output" });
  expect([...useWorkspace.getState().selection]).toEqual(["h"]);
});

it("keeps for each part whether its pictures are shown", () => {
  showPictures("fit", true);
  showPictures("fit", true);
  showPictures("clearance", true);
  showPictures("fit", false);
  expect(useChecks.getState().pictured).toEqual(["clearance"]);
});

it("has a key in the review, and says why results cannot be checked", () => {
  expect(commandFor("Shift+C", reviewCommands)).toBeUndefined();
  openStage("review");
  commandFor("Shift+C", reviewCommands)?.run();
  expect(useWorkspace.getState().checks.open).toBe(true);
  expect(whyNotCheck()).toContain("apply");
  useProject.setState({ cards: { a: sampleCard({ check: "c" }) } });
  expect(whyNotCheck()).toBeNull();
  useProject.setState({ jobs: [{ kind: "check", state: "running" } as Job] });
  expect(whyNotCheck()).toContain("now");
});

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
    expect(countByEdit([old, limit])).toBe(1);
    expect(findingsText([old, limit])).toBe("2 findings of the checks, 1 by the edit");
    expect(findingsText([old])).toBe("1 finding of the checks, all as before the edit");
    expect(findingsText([limit])).toBe("1 finding of the checks, by the edit");
  });

  it("has words for a rule without the part that it belongs to", () => {
    expect([limit, old, fault("fit-out"), fault("clearance-closed")].map(ruleTitle)).toEqual(["Vertices", "Gap", "Sticks out", "Closed"]);
  });

  it("weighs errors most, then what came with the edit, and what was not checked least", () => {
    const rows = [card("a", null), card("b", []), card("c", [old, old]), card("d", [limit]), card("e", [fault("fit-out")]), card("f", [broken])];
    const cards = Object.fromEntries(rows.map((one) => [one.asset, one]));
    const order = rows.map((one) => one.asset);
    const by = (engine: string) => filterAssets(cards, order, { search: "", only: [], sort: "findings" }, { vocabulary: [] }, engine);
    expect(by("")).toEqual(["f", "e", "c", "b", "d", "a"]);
    expect(by("physx-gpu")).toEqual(["f", "d", "e", "c", "b", "a"]);
    expect(rows.map((one) => weightOf(one, ""))).toEqual([-1, 0, 2, 0, 10, 10000]);
    expect(filterAssets(cards, order, { search: "", only: ["findings"], sort: "name" }, { vocabulary: [] })).toEqual(["c", "e", "f"]);
  });

  it("is a sign on the card, quieter where the edit brought none of it", () => {
    const sign = (faults: Fault[]) => badgesOf(card("a", faults), "").find(({ name }) => name === "findings");
    expect(sign([])).toBeUndefined();
    expect(sign([limit])).toBeUndefined();
    expect(sign([old])).toMatchObject({ count: 1, old: true });
    expect(sign([old, broken])).toMatchObject({ count: 2, old: false });
  });

  it("counts outputs that were not checked, not assets without one", () => {
    expect(countUnchecked([card("a", null), card("b", []), sampleCard()])).toBe(1);
  });
});
