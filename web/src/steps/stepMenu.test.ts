// What the menu of a step does.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import * as draft from "../store/draft";
import * as edits from "../store/edits";
import * as steps from "../store/steps";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import type { MenuLine } from "../ui/Menu";
import type { AssetView } from "../wire";
import { moveRule, setStepHere, stepMenu } from "./stepMenu";

const viewOf = (...selects: (string[] | null)[]) => ({ asset: "a", steps: selects.map((select) => ({ select, action: "Delete" })) }) as unknown as AssetView;
const inHand = (editing: number | null) => ({ name: "Merge", arguments: {}, each: false, label: null, editing });

function line(label: string, view: AssetView, place: number, rules = 3): MenuLine {
  const found = stepMenu(view, place, rules).find((one) => one !== "line" && one.label === label);
  if (!found || found === "line") throw new Error(`no line ${label}`);
  return found;
}

beforeEach(() => {
  useWorkspace.setState(initialWorkspace, true);
  vi.spyOn(draft, "draftStep").mockResolvedValue();
  vi.spyOn(draft, "dropDraft").mockResolvedValue();
  vi.spyOn(edits, "perform").mockResolvedValue(true);
  vi.spyOn(steps, "setStep").mockResolvedValue(true);
  vi.spyOn(steps, "removeStep").mockResolvedValue(true);
});

afterEach(() => {
  vi.restoreAllMocks();
});

describe("a line of the menu", () => {
  it("is disabled where it would change nothing", () => {
    const disabled = (view: AssetView) => stepMenu(view, 0, 1).flatMap((one) => (one !== "line" && one.disabled ? [one.label] : []));
    expect(disabled(viewOf(["x"]))).toEqual(["Move earlier on all assets", "Move later on all assets"]);
    expect(disabled(viewOf([]))).toContain("Nothing here");
    expect(disabled(viewOf(null))).toEqual(expect.arrayContaining(["Leave open", "Remove it here"]));
  });

  it("is disabled at the ends where it would move a rule beyond them", () => {
    const view = viewOf(["x"], ["y"], ["z"]);
    expect(line("Move earlier on all assets", view, 0).disabled).toBe(true);
    expect(line("Move earlier on all assets", view, 1).disabled).toBe(false);
    expect(line("Move later on all assets", view, 2).disabled).toBe(true);
  });

  it("changes the step", async () => {
    line("Change…", viewOf(["x"]), 0).onSelect();
    await vi.waitFor(() => expect(draft.draftStep).toHaveBeenCalledWith(0));
  });

  it("says that there is nothing here, or leaves the rule open", () => {
    line("Nothing here", viewOf(["x"]), 0).onSelect();
    line("Leave open", viewOf(["x"]), 0).onSelect();
    expect(vi.mocked(steps.setStep).mock.calls).toEqual([
      ["a", 0, []],
      ["a", 0, null],
    ]);
  });

  it("removes the rule on all assets, by its number from 1", () => {
    line("Remove the rule on all assets", viewOf(["x"], ["y"]), 1).onSelect();
    expect(edits.perform).toHaveBeenCalledWith({ kind: "delete-rule", rule: 2 });
  });
});

describe("setting a step", () => {
  it("puts down the action in hand that was for it", async () => {
    useWorkspace.setState({ draft: inHand(1) });
    await setStepHere("a", 1, []);
    expect(draft.dropDraft).toHaveBeenCalledOnce();
  });

  it("leaves an action in hand alone that is for another", async () => {
    useWorkspace.setState({ draft: inHand(0) });
    await setStepHere("a", 1, []);
    expect(draft.dropDraft).not.toHaveBeenCalled();
  });

  it("keeps the action in hand where the server refuses", async () => {
    vi.mocked(steps.setStep).mockResolvedValue(false);
    useWorkspace.setState({ draft: inHand(1) });
    await setStepHere("a", 1, []);
    expect(draft.dropDraft).not.toHaveBeenCalled();
  });

  it("says what goes wrong", async () => {
    vi.mocked(steps.setStep).mockRejectedValue(new Error("gone"));
    await expect(setStepHere("a", 1, [])).rejects.toThrow("gone");
  });
});

it("rules are moved by one edit", () => {
  moveRule(2, 0);
  expect(edits.perform).toHaveBeenCalledWith({ kind: "move-rule", rule: 3, to: 1 });
});
