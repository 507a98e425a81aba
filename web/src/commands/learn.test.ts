
import { beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { emptyProject, useProject } from "../store/project";
import { sampleAction } from "../store/sample.test-help";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import type { AnyEdit, OutcomeView, CandidateView } from "../wire";
import { chooseReading, demonstrate, learnCommands, showNearest } from "./learn";

const reading = (id: string): CandidateView => ({ id, rule: 2, extractor: "Geo(All, +Z)", sentence: "", size: 2, belief: 0.3, differs_on: ["y", "x"] });

let edits: AnyEdit[] = [];
beforeEach(() => {
  edits = [];
  vi.spyOn(api, "edit").mockImplementation((edit) => {
    edits.push(edit);
    return Promise.resolve({ message: "" });
  });
  useWorkspace.setState(initialWorkspace);
  useProject.setState(emptyProject);
});

describe("choosing a reading", () => {
  it("says what it selects where that rules out the others", async () => {
    const readings = [reading("r7"), { ...reading("r1"), extractor: "All", belief: 0.7 }];
    useProject.setState({ outcome: { readings } as unknown as OutcomeView });
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
  it("opens a demonstrated asset as the rule meets it", () => {
    showNearest({ rule: 3, extractor: "All", asset: "x", extra: ["p"], missing: [] }, ["p"]);
    expect(useWorkspace.getState().asked).toEqual({ kind: "steps", steps: 2 });
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
    const rules = [{ rule: 1, action: sampleAction(), shown: ["x"], nothing: [] }];
    useProject.setState({ project: { ...emptyProject.project, rules } });
    expect(learn?.enabled?.()).toBe(true);
    useProject.setState({ learning: true });
    expect(learn?.enabled?.()).toBe(false);
  });
});
