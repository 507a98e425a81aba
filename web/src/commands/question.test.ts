// What a reply to a question is: one edit, with the id of the choice.
import { beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { takeCall } from "../store/calls";
import { sampleQuestion } from "../store/sample.test-help";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import type { AnyEdit, ReviewChoiceView } from "../wire";
import { canBeRight, correctSelection, groupReply, putOff, questionCommands, reply, showAsked } from "./question";

const choice = (id: string, more: Partial<ReviewChoiceView> = {}): ReviewChoiceView => ({ id, text: id, label: null, select: null, sentence: "", orient: null, ...more });
const hulls = [
  { asset: "a", hull: "x", place: 0 },
  { asset: "b", hull: "y", place: 1 },
  { asset: "c", hull: "z", place: 0 },
];
const group = () => sampleQuestion({ hulls, choices: [choice("leg", { label: "leg" }), choice("panel", { label: "panel" })] });
const result = () => sampleQuestion({ kind: "result", asset: "a", choices: [choice("right"), choice("wrong"), choice("not-solved")] });

let edits: AnyEdit[] = [];
beforeEach(() => {
  edits = [];
  vi.spyOn(api, "edit").mockImplementation((edit) => {
    edits.push(edit);
    return Promise.resolve({ message: "", nothing: true });
  });
  useWorkspace.setState(initialWorkspace, true);
});

describe("a reply", () => {
  it("is one edit with the question as it was asked, and a second click none", async () => {
    const question = result();
    expect(await reply(question, { choice: "right" })).toBe(true);
    expect(await reply(question, { choice: "right" })).toBe(false);
    expect(edits).toEqual([{ kind: "reply", question, choice: "right" }]);
  });

  it("can be made again where it failed", async () => {
    const question = result();
    vi.mocked(api.edit).mockRejectedValueOnce(new Error("no"));
    expect(await reply(question, { choice: "right" })).toBe(false);
    expect(await putOff(question)).toBe(true);
    expect(edits).toEqual([{ kind: "reply", question, later: true }]);
  });

  it("names the hulls of a group that are something else, and all that are labelled where some are left out", () => {
    expect(groupReply(group(), { "a#x": "panel" })).toEqual({ choice: "leg", exceptions: [{ asset: "a", hull: "x", label: "panel" }] });
    const rows = [{ asset: "a", hull: "x", label: "panel" }, { asset: "b", hull: "y", label: "leg" }];
    expect(groupReply(group(), { "a#x": "panel", "c#z": null })).toEqual({ choice: null, exceptions: rows });
    expect(groupReply(group(), { "a#x": null, "b#y": null, "c#z": null })).toEqual({ choice: null, exceptions: [] });
  });

  it("says of a wrong result which hulls a rule should have taken: those selected in the view", async () => {
    const question = result();
    useWorkspace.setState({ selection: new Set(["y", "x"]) });
    await correctSelection(question, 2);
    expect(edits).toEqual([{ kind: "reply", question, choice: "wrong", selections: { 2: ["x", "y"] } }]);
  });
});

describe("what a question is about", () => {
  it("is a result where one of its choices is that it is right", () => {
    expect([result(), sampleQuestion({ kind: "result", choices: [choice("wrong", { text: "right" })] })].map(canBeRight)).toEqual([true, false]);
  });

  it("is opened with the hulls selected on which readings differ", () => {
    showAsked(sampleQuestion({ kind: "candidate", asset: "x", choices: [choice("a", { select: ["p", "q"] }), choice("b", { select: ["q", "s"] })] }));
    expect(useWorkspace.getState()).toMatchObject({ asset: "x", showing: { kind: "source" } });
    expect([...useWorkspace.getState().selection]).toEqual(["p", "s"]);
  });
});

describe("a call for the card", () => {
  it("is there for a card that comes after it, once", () => {
    useWorkspace.setState({ ...initialWorkspace, stage: "demonstrate" }, true);
    questionCommands[0]?.run();
    expect([takeCall("card"), takeCall("card")]).toEqual([true, false]);
  });
});
