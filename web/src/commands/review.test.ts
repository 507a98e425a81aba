
import { beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { whyNotApply } from "../store/jobs";
import { emptyProject, useProject } from "../store/project";
import { sampleCard } from "../store/sample.test-help";
import { useToasts } from "../store/toasts";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import type { AnyEdit, Card, EditHeader } from "../wire";
import { accept, acceptLegal, nextToReview, reviewCommands } from "./review";

const card = (asset: string, more: Partial<Card> = {}) =>
  sampleCard({ asset, output: "edited", after: 2, edited_picture: asset, ...more });

let edits: AnyEdit[] = [];
beforeEach(() => {
  edits = [];
  vi.spyOn(api, "edit").mockImplementation((edit) => {
    edits.push(edit);
    return Promise.resolve({ message: "" });
  });
  useWorkspace.setState({ ...initialWorkspace, stage: "review" });
  useToasts.setState({ toasts: [] });
});

function family(...cards: Card[]): void {
  const rows = Object.fromEntries(cards.map((one) => [one.asset, one]));
  const program = { ...emptyProject.program, text: "All => Merge" };
  useProject.setState({ ...emptyProject, cards: rows, order: cards.map((one) => one.asset), program });
}

const command = (id: string) => reviewCommands.find((one) => one.id === id);

describe("accepting", () => {
  it("goes on to the next that wants a look", async () => {
    const goals = ["old", "new"].map((goal) => ({ name: goal, goal, outcome: "failed" as const, why: "", hulls: [], before: null, accepted: goal === "old", fails: goal === "new", is_open: goal === "new", picture: null }));
    family(card("a", { goals }), card("b", { review: "accepted" }), card("c"));
    useWorkspace.setState({ asset: "a" });
    await accept("a");
    expect(edits).toEqual([{ kind: "review", ids: ["a"], verdict: "accepted", goals: ["old"] }]); // never a failure in silence
    expect(useWorkspace.getState().asset).toBe("c");
  });

  it("stays with the last one", async () => {
    family(card("a"), card("b", { review: "accepted" }));
    useWorkspace.setState({ asset: "a" });
    await accept("a");
    expect(useWorkspace.getState().asset).toBe("a");
  });

  it("takes all at once that are legal, and reports those that are not", async () => {
    family(card("a"), card("b"), card("c"));
    vi.spyOn(api, "result").mockImplementation((asset) => {
      const findings = asset === "b" ? [{ severity: "error", text: "not convex", hull: null }] : [];
      return Promise.resolve({ header: { findings } as unknown as EditHeader, rows: [], shapes: [] });
    });
    const steps: string[] = [];
    await acceptLegal(["a", "b"], (done, total) => steps.push(`${done}/${total}`));
    expect(edits).toEqual([{ kind: "review", ids: ["a"], verdict: "accepted" }]);
    expect(useToasts.getState().toasts[0]?.text).toMatch(/^1 not accepted/);
    expect(steps.at(-1)).toBe("2/2");
  });
});

describe("keys of the review stage", () => {
  it("accept nothing where there is no output", () => {
    family(card("a", { output: "failed" }));
    useWorkspace.setState({ asset: "a" });
    expect(command("accept")?.enabled?.()).toBe(false);
  });

  it("accept only what is up to date, which can be wrong all the same", () => {
    family(card("a", { stale: ["program"] }), card("b"));
    useWorkspace.setState({ asset: "a" });
    expect([command("accept")?.enabled?.(), command("wrong")?.enabled?.()]).toEqual([false, true]);
    useWorkspace.setState({ asset: "b" });
    expect(command("accept")?.enabled?.()).toBe(true);
  });

  it("call a result wrong, and take that back", () => {
    family(card("a"), card("b", { review: "wrong" }));
    useWorkspace.setState({ asset: "b" });
    command("wrong")?.run();
    useWorkspace.setState({ asset: "a" });
    command("wrong")?.run();
    return vi.waitFor(() => expect(edits.map((edit) => "verdict" in edit && edit.verdict)).toEqual([null, "wrong"]));
  });

  it("say so when nothing is left to review", () => {
    family(card("a", { review: "accepted" }));
    nextToReview();
    expect(useToasts.getState().toasts[0]?.text).toBe("Nothing is left to review.");
    family(card("a", { review: "accepted" }), card("b", { stale: ["program"] }));
    nextToReview();
    expect(useToasts.getState().toasts.at(-1)?.text).toBe("No other result is left to review; 1 output is not up to date.");
  });

  it("do not call a failed asset reviewed that is the only one left", () => {
    family(card("a", { review: "accepted" }), card("b", { output: "failed" }));
    useWorkspace.setState({ asset: "b" });
    nextToReview();
    expect(useToasts.getState().toasts[0]?.text).toBe("No other result needs review.");
  });
});

describe("why the program cannot be applied", () => {
  it("is told", () => {
    family();
    expect(whyNotApply()).toMatch(/no assets/);
    family(card("a"));
    expect(whyNotApply()).toBeNull();
    useProject.setState({ program: emptyProject.program });
    expect(whyNotApply()).toMatch(/no program yet/);
  });

  it("is that it is being applied", () => {
    family(card("a"));
    const job = { id: "1", kind: "apply", title: "", done: 0, total: 1, doing: "", left: null, state: "running", message: "", lines: [], out: null } as const;
    useProject.setState({ jobs: [{ ...job, lines: [] }] });
    expect(whyNotApply()).toBe("The program is being applied now.");
  });
});
