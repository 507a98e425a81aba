// Keys that demonstrate.
import { beforeEach, describe, expect, it, vi } from "vitest";
import * as draft from "../store/draft";
import * as guesses from "../store/guesses";
import { emptyProject, useProject } from "../store/project";
import { useScenes } from "../store/scenes";
import * as steps from "../store/steps";
import { initialWorkspace, select, useWorkspace } from "../store/workspace";
import { sampleAction, sampleForm } from "../store/sample.test-help";
import { startCut, startLandmarks } from "./demonstrate";
import { commandFor, listCommands } from "./list";

const command = (key: string) => commandFor(key, listCommands().filter(({ group }) => group === "Demonstrate"));
const press = (key: string) => command(key)?.run();
const inHand = { name: "Merge", arguments: {}, each: false, label: null, editing: null };
const step = (hulls: string[] | null) => ({ select: hulls, action: sampleAction(), error: null, made: [], removed: [] });

const actions = [sampleForm("Delete", [], { key: "X" }), sampleForm("Merge", [], { key: "M" }), sampleForm("Fold", [], { key: "Shift+K" }), sampleForm("Melt")];

function show(shown: readonly (string[] | null)[], rules = shown.length): void {
  const hulls = ["x", "y"].map((name) => ({ name }));
  useScenes.setState({ scene: { asset: "a", hulls, view: { asset: "a", hulls, steps: shown.map(step) } } as never });
  const lines = Array.from({ length: rules }, (_, k) => ({ rule: k + 1, action: sampleAction(), shown: [], nothing: [] }));
  useProject.setState({ ...emptyProject, language: { actions, operators: [], directions: [], goals: [] }, project: { ...emptyProject.project, rules: lines } }, true);
}

beforeEach(() => {
  vi.restoreAllMocks();
  vi.spyOn(draft, "startDraft").mockResolvedValue();
  vi.spyOn(draft, "acceptDraft").mockResolvedValue(true);
  vi.spyOn(draft, "dropDraft").mockResolvedValue();
  vi.spyOn(guesses, "acceptGuess").mockResolvedValue();
  vi.spyOn(steps, "removeStep").mockResolvedValue(true);
  useWorkspace.setState({ ...initialWorkspace, asset: "a", stage: "demonstrate" }, true);
  guesses.useGuesses.setState({ asset: null, guesses: [], loading: false, error: null });
  show([]);
});

describe("a key of an action", () => {
  it("begins it", () => {
    press("M");
    expect(draft.startDraft).toHaveBeenCalledWith("Merge");
    expect(command("M")?.title).toBe("Merge the selection");
  });

  it("of a plug-in is left to the command that has it; the action stays in the list of commands", () => {
    const keys = Object.fromEntries(listCommands().map((one) => [one.id, one.keys]));
    expect([keys["draft-fold"], keys["draft-melt"]]).toEqual([[], []]);
  });

  it("works on the result under review, too, and in no other stage", () => {
    useWorkspace.setState({ stage: "review", showing: { kind: "result", of: "output" } });
    expect(command("X")?.id).toBe("draft-delete");
    useWorkspace.setState({ showing: { kind: "source" } });
    expect(command("X")).toBeUndefined();
    useWorkspace.setState({ stage: "label" });
    expect(command("X")).toBeUndefined();
  });

  it("needs an asset", () => {
    useWorkspace.setState({ asset: null });
    expect(command("M")).toBeUndefined();
  });
});

describe("the action in hand", () => {
  it("is done to each part separately, or to all at once, by one key", () => {
    useWorkspace.setState({ draft: inHand });
    press("E");
    expect(useWorkspace.getState().draft?.each).toBe(true);
    press("E");
    expect(useWorkspace.getState().draft?.each).toBe(false);
  });

  it("is accepted by Enter, and cancelled by Escape", async () => {
    useWorkspace.setState({ draft: inHand });
    await press("Enter");
    expect(draft.acceptDraft).toHaveBeenCalledOnce();
    await press("Escape");
    expect(draft.dropDraft).toHaveBeenCalledOnce();
  });

  it("is what these keys are for: without one they mean nothing", () => {
    for (const key of ["E", "Enter", "Escape"]) expect(command(key)).toBeUndefined();
  });
});

describe("Enter with an empty hand", () => {
  const guess = (rule: number, error: string | null = null) => ({ rule, action: sampleAction(), select: ["x"], sentence: "", error });

  it("takes the guess for the first rule that the asset says nothing about", async () => {
    show([["x"], null]);
    guesses.useGuesses.setState({ asset: "a", guesses: [guess(1), guess(2)] });
    await press("Enter");
    expect(guesses.acceptGuess).toHaveBeenCalledWith(2);
  });

  it("means nothing where there is no guess, or none that works", () => {
    show([null]);
    expect(command("Enter")).toBeUndefined();
    guesses.useGuesses.setState({ asset: "a", guesses: [guess(1, "no leg")] });
    expect(command("Enter")).toBeUndefined();
  });

  it("means nothing while another asset is still shown", () => {
    show([null]);
    guesses.useGuesses.setState({ asset: "a", guesses: [guess(1)] });
    useWorkspace.setState({ asset: "b" });
    expect(command("Enter")).toBeUndefined();
  });
});

describe("Backspace", () => {
  it("removes the step that is shown last", async () => {
    show([["x"], ["y"]]);
    useWorkspace.setState({ showing: { kind: "steps", steps: 2 } });
    await press("Backspace");
    expect(steps.removeStep).toHaveBeenCalledWith("a", 1);
  });

  it("leaves the steps alone while an action is in hand, and before the first", () => {
    show([["x"]]);
    useWorkspace.setState({ showing: { kind: "steps", steps: 1 }, draft: inHand });
    expect(command("Backspace")).toBeUndefined();
    useWorkspace.setState({ showing: { kind: "steps", steps: 0 }, draft: null });
    expect(command("Backspace")).toBeUndefined();
  });
});

describe("cutting and landmarks", () => {
  it("work on the original asset", () => {
    useWorkspace.setState({ showing: { kind: "steps", steps: 1 } });
    startCut();
    expect([useWorkspace.getState().tool, useWorkspace.getState().showing.kind]).toEqual(["cut", "source"]);
    useWorkspace.setState({ showing: { kind: "steps", steps: 1 } });
    startLandmarks();
    expect([useWorkspace.getState().tool, useWorkspace.getState().showing.kind]).toEqual(["landmark", "source"]);
  });

  it("need exactly one selected hull for a cut", () => {
    expect(command("K")).toBeUndefined();
    select(["x", "y"]);
    expect(command("K")).toBeUndefined();
    select(["y"]);
    expect(command("K")?.id).toBe("cut");
  });
});
