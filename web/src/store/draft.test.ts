
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import type { ActionView, AnyEdit, AssetView, StepView } from "../wire";
import { acceptDraft, changeDraft, draftStep, dropDraft, startDraft, toggleEach, useDraftStatus } from "./draft";
import { acceptGuess, followGuesses, useGuesses } from "./guesses";
import { followPreview, usePreview } from "./preview";
import { emptyProject, receive, useProject } from "./project";
import { sampleAction, sampleArgument, sampleCall, sampleForm } from "./sample.test-help";
import { useScenes } from "./scenes";
import { initialOffers, removeStep, useOffers } from "./steps";
import { useToasts } from "./toasts";
import { initialWorkspace, select, useWorkspace } from "./workspace";

const actions = [
  sampleForm("Delete"),
  sampleForm("Merge"),
  sampleForm("Replace", [sampleArgument("geometry", "shape", ["box", "capsule"]), sampleArgument("fit", "words", ["tight"], false)]),
];
const merge = sampleCall("Merge");
const eachMerge = sampleAction("Merge", { each: true });
const step = (select: string[] | null, action = "Delete"): StepView => ({
  select,
  action: sampleAction(action),
  error: null,
  made: [],
  removed: [],
});
const rule = (number: number, action: string | ActionView) => ({
  rule: number,
  action: typeof action === "string" ? sampleAction(action) : action,
  shown: ["other"],
  nothing: [],
});
const packet = { header: { rows: [], hulls: [], made: [], removed: ["x"] }, rows: [], shapes: [] } as never;

let sent: AnyEdit[] = [];
let view: AssetView;

function given(steps: StepView[], rules: (string | ActionView)[]): void {
  view = {
    asset: "a",
    steps,
    version: "v1",
    hulls: ["x", "y", "z"].map((name) => ({ name })),
    non_convex: [],
  } as unknown as AssetView;
  const state = {
    ...emptyProject,
    language: { actions, operators: [], directions: [], goals: [] },
    revisions: { a: ++revision },
    program: { ...emptyProject.program, text: "p", version: String(revision) },
  };
  useProject.setState(
    { ...state, project: { ...emptyProject.project, rules: rules.map((action, k) => rule(k + 1, action)) } },
    true,
  );
  useWorkspace.setState(
    { ...initialWorkspace, asset: "a", stage: "demonstrate", showing: { kind: "steps", steps: steps.length } },
    true,
  );
  useScenes.setState({ scene: { asset: "a", view, hulls: view.hulls } as never });
}
let revision = 0;

beforeEach(() => {
  sent = [];
  vi.useFakeTimers();
  useDraftStatus.setState({ sending: false, problem: null, landing: null });
  useOffers.setState(initialOffers);
  vi.spyOn(api, "asset").mockImplementation(async () => view);
  vi.spyOn(api, "shapes").mockResolvedValue({ header: { rows: [] }, rows: [], shapes: [] });
  vi.spyOn(api, "edit").mockImplementation(async (edit) => {
    sent.push(edit);
    receive({ kind: "assets", assets: ["a"], shapes: false });
    return { message: "" };
  });
  vi.spyOn(api, "preview").mockResolvedValue(packet);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

describe("an action in hand", () => {
  it("leaves what was begun and selected while it was sent", async () => {
    given([], []);
    useWorkspace.setState({ draft: { name: "Delete", arguments: {}, each: false, label: null, editing: null }, selection: new Set(["x"]) });
    const accepted = acceptDraft();
    select(["y"]);
    expect(await accepted).toBe(true);
    expect(sent[0]).toMatchObject({ steps: [{ select: ["x"], action: sampleCall() }] });
    expect(useWorkspace.getState()).toMatchObject({ draft: null, selection: new Set(["y"]) });
  });

  it("begins as the first open rule of its kind does it elsewhere", async () => {
    given([step(["x"])], ["Delete", sampleAction("Replace", { arguments: { geometry: "capsule", fit: "tight" }, each: true, label: "leg" })]);
    await startDraft("Replace");
    const { draft, showing } = useWorkspace.getState();
    expect(draft).toEqual({
      name: "Replace",
      arguments: { geometry: "capsule", fit: "tight" },
      each: true,
      label: "leg",
      editing: 1,
    });
    expect(showing).toEqual({ kind: "steps", steps: 1 });
  });

  it("keeps each part separate where its rule does and the person says it once more", async () => {
    given([step(["x"])], ["Delete", eachMerge]);
    await startDraft("Merge");
    const isEach = () => useWorkspace.getState().draft?.each;
    expect(isEach()).toBe(true);
    toggleEach();
    expect(isEach()).toBe(true);
    toggleEach();
    expect(isEach()).toBe(false);
    toggleEach();
    expect(isEach()).toBe(true);
    given([], []);
    await startDraft("Merge");
    toggleEach();
    expect(isEach()).toBe(true);
    toggleEach();
    expect(isEach()).toBe(false);
  });

  it("is a new rule with usual arguments where none of its kind is open", async () => {
    given([step(["x"])], ["Delete"]);
    await startDraft("Replace");
    expect(useWorkspace.getState().draft).toMatchObject({ arguments: { geometry: "box" }, editing: null });
  });

  it("becomes a step after all rules of the family, those before it left open", async () => {
    given([], ["Delete"]);
    await startDraft("Merge");
    select(["y", "gone", "x"]);
    expect(await acceptDraft()).toBe(true);
    expect(sent).toEqual([
      {
        kind: "steps",
        asset: "a",
        version: "v1",
        steps: [
          { select: null, action: sampleCall() },
          { select: ["x", "y"], action: merge },
        ],
      },
    ]);
    expect(useWorkspace.getState()).toMatchObject({ draft: null, selection: new Set() });
  });

  it("takes the place of the step that it was taken from", async () => {
    given([step(["x"]), step(["y"], "Merge")], ["Delete", "Merge"]);
    await draftStep(1);
    expect([...useWorkspace.getState().selection]).toEqual(["y"]);
    expect(useWorkspace.getState()).toMatchObject({
      showing: { kind: "steps", steps: 1 },
      asked: { kind: "steps", steps: 1 },
    });
    changeDraft({ each: true });
    expect(await acceptDraft()).toBe(false); // as the rule does something else on another asset, and no program does both
    expect(useToasts.getState().toasts.at(-1)?.text).toMatch(/^This rule does something else on/);
    useProject.setState(({ project }) => ({ project: { ...project, rules: project.rules.map((one) => ({ ...one, shown: ["a"] })) } }));
    await acceptDraft();
    expect(sent[0]).toMatchObject({ steps: [{ select: ["x"] }, { select: ["y"], action: { ...merge, each: true } }] });
  });

  it("stays the step that is changed with another action", async () => {
    given([step(["x"]), step(["y"], "Merge")], ["Delete", "Merge", sampleAction("Replace", { arguments: { geometry: "capsule" } })]);
    await draftStep(1);
    await startDraft("Replace");
    expect(useWorkspace.getState().draft).toMatchObject({ name: "Replace", arguments: { geometry: "box" }, editing: 1 });
    expect([...useWorkspace.getState().selection]).toEqual(["y"]);
  });

  it("is no step while nothing is selected", async () => {
    given([], []);
    await startDraft("Delete");
    expect(await acceptDraft()).toBe(false);
    expect(sent).toEqual([]);
    expect(useToasts.getState().toasts.at(-1)?.text).toMatch(/Nothing is selected/);
  });

  it("is an edit by hand while reviewing", async () => {
    given([], ["Delete"]);
    useWorkspace.setState({ stage: "review", showing: { kind: "result", of: "program" } });
    await startDraft("Delete");
    select(["z"]);
    await acceptDraft();
    expect(sent).toEqual([{ kind: "correct", asset: "a", select: ["z"], action: sampleCall() }]);
  });

  it("stays in the hand where the server refuses it", async () => {
    given([], []);
    vi.mocked(api.edit).mockRejectedValue(new Error("no"));
    await startDraft("Delete");
    select(["x"]);
    expect(await acceptDraft()).toBe(false);
    expect(useWorkspace.getState().draft?.name).toBe("Delete");
  });
});

describe("the preview", () => {
  it("is asked once for changes in a row, and goes with the action", async () => {
    given([step(["x"])], ["Delete"]);
    const stop = followPreview(false);
    await startDraft("Merge");
    select(["x"]);
    select(["x", "y"]);
    await vi.advanceTimersByTimeAsync(100);
    expect(vi.mocked(api.preview).mock.calls.map(([request]) => request)).toEqual([
      { asset: "a", select: ["x", "y"], action: merge, steps: 1 },
    ]);
    expect(usePreview.getState().preview).toBe(packet);
    await dropDraft();
    await vi.advanceTimersByTimeAsync(100);
    expect(usePreview.getState().preview).toBeNull();
    stop();
  });
});

describe("guesses", () => {
  const guess = (number: number, select: string[], action = "Delete") => ({
    rule: number,
    action: sampleAction(action),
    select,
    sentence: "",
    error: null,
  });

  it("are offered one after the other to an empty hand", async () => {
    given([step(["x"])], ["Delete", "Merge"]);
    vi.spyOn(api, "guesses").mockResolvedValue([guess(1, ["x"]), guess(2, ["y", "z"], "Merge")]);
    const stop = followGuesses();
    await vi.advanceTimersByTimeAsync(10);
    expect(useWorkspace.getState()).toMatchObject({
      draft: { name: "Merge", editing: 1 },
      selection: new Set(["y", "z"]),
    });
    await dropDraft();
    await vi.advanceTimersByTimeAsync(10);
    expect(useWorkspace.getState().draft).toBeNull();
    stop();
  });

  it("pass over a step that was taken away", async () => {
    given([step(["x"])], ["Delete", "Merge"]);
    await removeStep("a", 0);
    given([step(null)], ["Delete", "Merge"]);
    vi.spyOn(api, "guesses").mockResolvedValue([guess(1, ["x"]), guess(2, ["y"], "Merge")]);
    const stop = followGuesses();
    await vi.advanceTimersByTimeAsync(10);
    expect(useWorkspace.getState().draft?.editing).toBe(1);
    stop();
  });

  it("leave alone who has something in the hand", async () => {
    given([], ["Delete"]);
    select(["z"]);
    vi.spyOn(api, "guesses").mockResolvedValue([guess(1, ["x"])]);
    const stop = followGuesses();
    await vi.advanceTimersByTimeAsync(10);
    expect(useWorkspace.getState()).toMatchObject({ draft: null, selection: new Set(["z"]) });
    stop();
  });

  it("become steps as they are, also where they say nothing here", async () => {
    given([], ["Delete"]);
    useGuesses.setState({ asset: "a", guesses: [guess(1, [])], loading: false, error: null });
    await acceptGuess(1);
    expect(sent[0]).toMatchObject({ steps: [{ select: [], action: sampleCall() }] });
  });
});
