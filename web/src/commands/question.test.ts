// What a reply to a question becomes: edits that there are already, where there are any.
import { afterEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { emptyProject, useProject } from "../store/project";
import { sampleCard, sampleQuestion } from "../store/sample.test-help";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import { acceptResult, editsFor, labelGroup, questionCommands, takeCall } from "./question";

const choice = (text: string, more: object = {}) => ({ text, label: null, select: null, sentence: "", orient: null, ...more });
const hulls = [{ asset: "a", hull: "x", place: 0 }, { asset: "b", hull: "y", place: 1 }];

describe("a reply", () => {
  it("labels a group in one edit; none of the labels puts the question off", () => {
    const question = sampleQuestion({ hulls, choices: [choice("leg", { label: "leg" })] });
    const places = [{ asset: "a", hull: "x" }, { asset: "b", hull: "y" }];
    expect(editsFor(question, 0)).toEqual([{ kind: "label-group", hulls: places, label: "leg" }]);
    expect(editsFor(question, null)).toEqual([{ kind: "put-off", id: "group-1" }]);
  });

  it("accepts or rejects a repair", () => {
    const choices = [choice("leg", { label: "leg" }), choice("panel", { label: "panel" })];
    const question = sampleQuestion({ kind: "repair", hulls: hulls.slice(0, 1), was: "panel", choices });
    const repair = { kind: "repair", asset: "a", hull: "x", was: "panel", to: "leg" };
    expect(editsFor(question, 0)).toEqual([{ ...repair, accept: true }]);
    expect(editsFor(question, 1)).toEqual([{ ...repair, accept: false }]);
  });

  it("answers about readings, or refuses all of them", () => {
    const choices = [choice("Is(a)", { select: ["x"] }), choice("Is(b)", { select: [] })];
    const question = sampleQuestion({ kind: "reading", rule: 2, choices });
    const answer = { kind: "answer", rule: 2, asset: "a0" };
    expect(editsFor(question, 1)).toEqual([{ ...answer, select: [], refused: [] }]);
    expect(editsFor(question, null)).toEqual([{ ...answer, select: null, refused: [["x"], []] }]);
  });

  it("corrects a demonstration with a slip, or leaves it", () => {
    const choices = [choice("yes, by mistake", { select: ["x", "y"] }), choice("no, on purpose", { select: ["x"] })];
    const slip = sampleQuestion({ kind: "selection", rule: 2, hulls: hulls.slice(0, 1), choices });
    expect(editsFor(slip, 0)).toEqual([{ kind: "correct-selection", asset: "a0", rule: 2, select: ["x", "y"] }]);
    expect(editsFor(slip, 1)).toEqual([{ kind: "put-off", id: "group-1" }]);
  });

  it("splits a hull, keeps that it is one part, or asks later", () => {
    const span = sampleQuestion({ kind: "span", hulls: hulls.slice(0, 1), choices: [choice("split so: leg (98%)"), choice("no, it is one part")] });
    expect(editsFor(span, 0)).toEqual([{ kind: "split-span", asset: "a", hull: "x" }]);
    expect(editsFor(span, 1)).toEqual([{ kind: "one-part", asset: "a", hull: "x" }]);
    expect(editsFor(span, null)).toEqual([{ kind: "put-off", id: "group-1" }]);
  });

  it("accepts a result, takes an orientation", () => {
    const result = sampleQuestion({ kind: "result", choices: [choice("right"), choice("wrong")] });
    expect(editsFor(result, 0)).toEqual([{ kind: "review", ids: ["a0"], verdict: "accepted" }]);
    const orient = sampleQuestion({ kind: "orientation", choices: [choice("yes", { orient: "+Z: Is(a) -> Is(b)" }), choice("no")] });
    expect(editsFor(orient, 0)[0]).toEqual({ kind: "orient", text: "+Z: Is(a) -> Is(b)" });
    expect(editsFor(orient, 1)).toEqual([{ kind: "put-off", id: "group-1" }]);
  });
});

describe("a reply with more to it", () => {
  afterEach(() => vi.restoreAllMocks());

  const edits = () => vi.spyOn(api, "edit").mockResolvedValue({ said: "", nothing: true } as never);

  it("labels exceptions otherwise, and leaves out what is left out", async () => {
    const edit = edits();
    const three = [...hulls, { asset: "c", hull: "z", place: 0 }];
    await labelGroup(sampleQuestion({ hulls: three }), "leg", { a: "panel", c: null });
    const rows = [{ asset: "a", hull: "x", label: "panel" }, { asset: "b", hull: "y", label: null }];
    expect(edit).toHaveBeenCalledExactlyOnceWith({ kind: "label-group", hulls: rows, label: "leg" });
  });

  it("makes a result that is not there, and accepts it once it is", async () => {
    const edit = edits();
    const start = vi.spyOn(api, "startJob").mockResolvedValue({ id: "1" } as never);
    useProject.setState({ ...emptyProject, cards: { a: sampleCard({ output: "edited", stale: ["program"] }) } });
    const accepted = acceptResult("a");
    await vi.waitFor(() => expect(start).toHaveBeenCalledWith({ kind: "apply", assets: ["a"], split: true }));
    expect(edit).not.toHaveBeenCalled();
    useProject.setState({ cards: { a: sampleCard({ output: "edited" }) } });
    expect(await accepted).toBe(true);
    expect(edit).toHaveBeenCalledExactlyOnceWith({ kind: "review", ids: ["a"], verdict: "accepted" });
  });

  it("accepts nothing that could not be made", async () => {
    const edit = edits();
    vi.spyOn(api, "startJob").mockResolvedValue({ id: "1" } as never);
    const failed = { id: "1", kind: "apply", state: "failed" };
    useProject.setState({ ...emptyProject, cards: { a: sampleCard() }, jobs: [failed as never] });
    expect(await acceptResult("a")).toBe(false);
    useProject.setState({ cards: { a: sampleCard({ output: "failed" }) }, jobs: [{ ...failed, state: "done" } as never] }); // the program fails on it
    expect(await acceptResult("a")).toBe(false);
    expect(edit).not.toHaveBeenCalled();
  });
});

describe("a call for the card", () => {
  it("is there for a card that comes after it, once", () => {
    useWorkspace.setState({ ...initialWorkspace, stage: "demonstrate" }, true);
    questionCommands[0]?.run();
    expect([takeCall(), takeCall()]).toEqual([true, false]);
  });
});
