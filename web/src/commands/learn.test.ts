
import { beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { emptyProject, useProject } from "../store/project";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import type { AnyEdit, OutcomeView, QuestionView, ReadingView } from "../wire";
import { answer, chooseReading, demonstrate, learnCommands, showNearest, showQuestion, showRepair } from "./learn";

const question: QuestionView = {
  id: "2:x",
  rule: 2,
  asset: "x",
  choices: [
    { reading: "r1", extractor: "Is(a)", sentence: "", select: ["p", "q"] },
    { reading: "r2", extractor: "Is(b)", sentence: "", select: ["q", "s"] },
  ],
  harm: 0.2,
  left: 0,
};
const reading = (id: string): ReadingView => ({ id, rule: 2, extractor: "Geo(All, +Z)", sentence: "", size: 2, belief: 0.3, differs_on: ["y", "x"] });

let edits: AnyEdit[] = [];
beforeEach(() => {
  edits = [];
  vi.spyOn(api, "edit").mockImplementation((edit) => {
    edits.push(edit);
    return Promise.resolve({ said: "" });
  });
  useWorkspace.setState(initialWorkspace);
  useProject.setState(emptyProject);
});

describe("answering", () => {
  it("says what the rule selects", async () => {
    await answer(question, 1);
    expect(edits).toEqual([{ kind: "answer", rule: 2, asset: "x", select: ["q", "s"], refused: [] }]);
  });

  it("refuses all choices with neither", async () => {
    await answer(question, null);
    expect(edits[0]).toMatchObject({ select: null, refused: [["p", "q"], ["q", "s"]] });
  });

  it("means a reading that is among the choices by that choice", async () => {
    useProject.setState({ outcome: { question, readings: [] } as unknown as OutcomeView });
    await chooseReading(reading("r2"));
    expect(edits[0]).toMatchObject({ asset: "x", select: ["q", "s"] });
  });

  it("means another reading by what it selects where that rules out the others", async () => {
    const readings = [reading("r7"), { ...reading("r1"), extractor: "All", belief: 0.7 }];
    useProject.setState({ outcome: { question, readings } as unknown as OutcomeView });
    vi.spyOn(api, "generalise").mockImplementation((extractor) =>
      Promise.resolve({ assets: extractor === "All" ? { x: [0], y: [0, 1] } : { x: [0], y: [1] } }),
    );
    const asked = vi.spyOn(api, "select").mockResolvedValue({ select: ["t"], sentence: "", mark: null });
    await chooseReading(reading("r7"));
    expect(asked).toHaveBeenCalledWith({ asset: "y", rule: 2, extractor: "Geo(All, +Z)" });
    expect(edits).toEqual([{ kind: "answer", rule: 2, asset: "y", select: ["t"] }]);
  });
});

describe("showing", () => {
  it("selects the hulls on which the choices differ", () => {
    showQuestion(question);
    expect(useWorkspace.getState()).toMatchObject({ asset: "x", showing: { kind: "source" } });
    expect([...useWorkspace.getState().selection]).toEqual(["p", "s"]);
  });

  it("opens a demonstrated asset as the rule meets it", () => {
    showNearest({ rule: 3, extractor: "All", asset: "x", extra: ["p"], missing: [] }, ["p"]);
    expect(useWorkspace.getState().asked).toEqual({ kind: "steps", steps: 2 });
  });

  it("selects the hull of a repair in the original asset", () => {
    showRepair({ id: "", rule: 1, asset: "x", hull: "p", was: null, to: "a", belief: 0.5, why: "" });
    expect([...useWorkspace.getState().selection]).toEqual(["p"]);
  });

  it("goes to the demonstrate stage with the asset that helps most", () => {
    demonstrate("y");
    expect(useWorkspace.getState()).toMatchObject({ asset: "y", stage: "demonstrate", asked: null });
  });
});

describe("the command to learn", () => {
  const learn = learnCommands.find((command) => command.id === "learn");

  it("makes sense once something is shown and while nothing is learned", () => {
    expect(learn?.enabled?.()).toBe(false);
    const rules = [{ rule: 1, action: "Delete", shown: ["x"], nothing: [] }];
    useProject.setState({ project: { ...emptyProject.project, rules } });
    expect(learn?.enabled?.()).toBe(true);
    useProject.setState({ learning: true });
    expect(learn?.enabled?.()).toBe(false);
  });
});
