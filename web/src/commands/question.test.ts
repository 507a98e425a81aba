// What a reply to a question becomes: edits that there are already, where there are any.
import { describe, expect, it } from "vitest";
import { sampleQuestion } from "../store/sample.test-help";
import { editsFor } from "./question";

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

  it("accepts a result, takes an orientation", () => {
    const result = sampleQuestion({ kind: "result", choices: [choice("right"), choice("wrong")] });
    expect(editsFor(result, 0)).toEqual([{ kind: "review", ids: ["a0"], verdict: "accepted" }]);
    const orient = sampleQuestion({ kind: "orientation", choices: [choice("yes", { orient: "+Z: Is(a) -> Is(b)" }), choice("no")] });
    expect(editsFor(orient, 0)[0]).toEqual({ kind: "orient", text: "+Z: Is(a) -> Is(b)" });
    expect(editsFor(orient, 1)).toEqual([{ kind: "put-off", id: "group-1" }]);
  });
});
