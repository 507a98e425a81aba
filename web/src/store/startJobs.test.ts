// Starting and stopping long work, and why it cannot be started.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Job, JobLine } from "../wire";
import {
  applyTo,
  cancelJob,
  checkAll,
  exportTo,
  findSpanning,
  rebuildBodies,
  labelAll,
  makeHulls,
  progressText,
  whyNotApply,
  whyNotCheck,
  whyNotRebuild,
} from "./jobs";
import { emptyProject, type ProjectState, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { useToasts } from "./toasts";

const job = (kind: Job["kind"], state: Job["state"] = "running"): Job => ({ id: kind, kind, title: "", done: 0, total: 2, doing: "", left: null, state, message: "", lines: [], out: null });
const found = (asset: string, body: string): JobLine => ({ asset, body, status: "done", text: "", before: [], picture: null, hulls: [] });
const set = (state: Partial<ProjectState>) => useProject.setState(state);
const program = { ...emptyProject.program, text: "All => Delete" };
const refusal = new ServerProblem({ message: "another job runs", where: null, remedy: "Stop it.", conflict: true }, 409);
const toasts = () => useToasts.getState().toasts.map(({ text, remedy }) => [text, remedy]);

beforeEach(() => {
  useProject.setState({ ...emptyProject, order: ["a"], cards: { a: sampleCard() }, program }, true);
  useToasts.setState({ toasts: [] });
  vi.spyOn(api, "startJob").mockResolvedValue(job("apply"));
});

afterEach(() => {
  vi.restoreAllMocks();
});

describe("a job", () => {
  it("is asked for as the server has it", async () => {
    await applyTo(null);
    await applyTo(["a"]);
    await labelAll();
    await checkAll();
    await findSpanning();
    await rebuildBodies([found("a", "base"), found("a", "lid"), found("b", "base")], false);
    await exportTo("out", true);
    makeHulls(["a"], { method: "coacd", most: 8 });
    await vi.waitFor(() => expect(api.startJob).toHaveBeenCalledTimes(8));
    expect(vi.mocked(api.startJob).mock.calls.map(([request]) => request)).toEqual([
      { kind: "apply", assets: null, rebuild: true },
      { kind: "apply", assets: ["a"], rebuild: true },
      { kind: "label" },
      { kind: "check" },
      { kind: "rebuild" },
      { kind: "rebuild", bodies: { a: ["base", "lid"], b: ["base"] }, every: false },
      { kind: "export", folder: "out", signed_only: true },
      { kind: "decompose", assets: ["a"], method: "coacd", most: 8 },
    ]);
  });

  it("says how far it is, and for how long it may go on", () => {
    const at = (left: number | null) => progressText({ ...job("decompose"), done: 23, total: 61, left });
    expect([at(null), at(40.2), at(200), at(9000)]).toEqual(["23 of 61 pieces", "23 of 61 pieces, about 40 s left", "23 of 61 pieces, about 3 min left", "23 of 61 pieces, about 3 h left"]);
  });

  it("that begins says so", async () => {
    expect(await applyTo(null)).toBe(true);
  });

  it("that cannot begin is reported with its remedy", async () => {
    vi.mocked(api.startJob).mockRejectedValue(refusal);
    expect(await applyTo(null)).toBe(false);
    makeHulls(["a"], { method: "coacd", most: 8 });
    await vi.waitFor(() => expect(api.startJob).toHaveBeenCalledTimes(2));
    expect(toasts()).toEqual([["another job runs", "Stop it."]]);
  });

  it("is stopped by its number; one that cannot be stopped says so", async () => {
    const stop = vi.spyOn(api, "cancelJob").mockRejectedValue(refusal);
    await expect(cancelJob("7")).rejects.toBe(refusal);
    expect(stop).toHaveBeenCalledWith("7");
  });
});

describe("the program can be applied", () => {
  it("where there are assets, and a program that can be read", () => {
    expect(whyNotApply()).toBeNull();
  });

  it.each([
    ["no assets", { order: [] }],
    ["cannot be read: line 2", { program: { ...program, error: "line 2" } }],
    ["no program yet", { program: { ...program, text: " \n" } }],
    ["settings are broken", { project: { ...emptyProject.project, problem: "settings are broken" } }],
    ["being applied now", { jobs: [job("apply")] }],
  ] as [string, Partial<ProjectState>][])("but not where it says: %s", (why, state) => {
    set(state);
    expect(whyNotApply()).toContain(why);
  });

  it("again once the last time is over, and beside other jobs", () => {
    set({ jobs: [job("apply", "done"), job("export")] });
    expect(whyNotApply()).toBeNull();
  });
});

describe("results can be checked", () => {
  it("where something is written, and no check runs", () => {
    expect(whyNotCheck()).toContain("apply the program");
    set({ cards: { a: sampleCard({ check: "digest" }) } });
    expect(whyNotCheck()).toBeNull();
    set({ jobs: [job("check")] });
    expect(whyNotCheck()).toContain("checked now");
  });
});

describe("hulls that span parts can be looked for", () => {
  it("where a hull has a label, and they are not being looked for", () => {
    set({ cards: { a: sampleCard({ labels: [-1, -1] }) } });
    expect(whyNotRebuild()).toContain("Label the hulls");
    set({ cards: { a: sampleCard({ labels: [-1, 0] }) } });
    expect(whyNotRebuild()).toBeNull();
    set({ jobs: [job("rebuild")] });
    expect(whyNotRebuild()).toContain("looked for now");
    set({ jobs: [job("rebuild", "cancelled")], order: [] });
    expect(whyNotRebuild()).toContain("no assets");
  });
});
