
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { labelCommands } from "../commands/label";
import { api } from "../server/api";
import type { AnyEdit } from "../wire";
import { addLabels, countLabels, endStroke, labelHulls, moveItem, paint } from "./labels";
import { emptyProject, useProject } from "./project";
import { applyLabel } from "./labelWalk";
import { sampleCard } from "./sample.test-help";
import { useScenes } from "./scenes";
import { initialWorkspace, select, setBrush, useWorkspace } from "./workspace";

const hull = (name: string, label: string | null) => ({ name, label, confidence: 0.3, source: "name" });
const hulls = [hull("x", "leg"), hull("y", null), hull("z", "panel")];
let sent: AnyEdit[] = [];

beforeEach(() => {
  sent = [];
  vi.useFakeTimers();
  const vocabulary = ["leg", "panel"].map((name) => ({ name, text: name, color: "#000000", used: 1, is_class: false }));
  const cards = Object.fromEntries(["a", "b"].map((asset) => [asset, sampleCard({ asset, labels: [0, -1, 1], confidence: [30, -1, 80] })]));
  useProject.setState(
    { ...emptyProject, order: ["a", "b"], cards, project: { ...emptyProject.project, vocabulary } },
    true,
  );
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useScenes.setState({ scene: { asset: "a", view: { hulls }, hulls } as never });
  vi.spyOn(api, "edit").mockImplementation(async (edit) => (sent.push(edit), { message: "" }));
  vi.spyOn(api, "asset").mockResolvedValue({ asset: "b", hulls } as never);
  vi.spyOn(api, "shapes").mockResolvedValue({ header: { rows: [] }, rows: [], shapes: [] });
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

const labels = () => useScenes.getState().scene?.hulls.map((one) => one.label);
const press = (key: string) =>
  labelCommands.find(({ keys, enabled }) => keys.includes(key) && (enabled?.() ?? true))?.run();

describe("a label", () => {
  it("is given to the selection, which stays, and is shown at once", async () => {
    select(["x", "y", "made~1"]);
    press("2");
    expect(labels()).toEqual(["panel", "panel", "panel"]);
    await vi.runAllTimersAsync();
    expect(sent).toEqual([{ kind: "label", hulls: { a: ["x", "y"] }, label: "panel" }]);
    expect(useWorkspace.getState().selection.size).toBe(3);
  });

  it("goes back in what is shown where the server refuses it", async () => {
    vi.mocked(api.edit).mockRejectedValue(new Error("no"));
    expect(await labelHulls("a", ["y"], "leg")).toBe(false);
    expect(labels()).toEqual(["leg", null, "panel"]);
  });

  it("is put in the brush where nothing is selected, and taken out by the same key", () => {
    press("1");
    expect(useWorkspace.getState().brush).toBe("leg");
    press("1");
    expect(useWorkspace.getState().brush).toBeNull();
    applyLabel(null);
    expect(useWorkspace.getState().brush).toBe("");
  });

  it("has no key where there is no such label, nor in other stages", () => {
    press("3");
    expect(useWorkspace.getState().brush).toBeNull();
    useWorkspace.setState({ stage: "demonstrate" });
    press("1");
    expect(useWorkspace.getState().brush).toBeNull();
  });
});

describe("painting", () => {
  it("makes one edit of a stroke", async () => {
    setBrush("leg");
    paint(["y"]);
    paint(["y", "z"]);
    expect(labels()).toEqual(["leg", "leg", "leg"]);
    await vi.runAllTimersAsync();
    expect(sent).toEqual([]);
    endStroke();
    await vi.runAllTimersAsync();
    expect(sent).toEqual([{ kind: "label", hulls: { a: ["y", "z"] }, label: "leg" }]);
  });

  it("takes labels away with the empty brush", async () => {
    setBrush("");
    paint(["x"]);
    endStroke();
    await vi.runAllTimersAsync();
    expect(sent).toEqual([{ kind: "label", hulls: { a: ["x"] }, label: null }]);
  });
});

it("adds several labels at once, each only once", () => {
  expect(addLabels(["leg"], " door,drawer ,, leg,table   top,door")).toEqual(["leg", "door", "drawer", "table top"]);
  expect(addLabels(["leg"], " , ")).toEqual(["leg"]);
});

it("moves a line up, down, and no further than the ends", () => {
  expect(moveItem(["a", "b", "c"], 2, 0)).toEqual(["c", "a", "b"]);
  expect(moveItem(["a", "b", "c"], 0, 1)).toEqual(["b", "a", "c"]);
  expect(moveItem(["a", "b", "c"], 0, 9)).toEqual(["b", "c", "a"]);
});

describe("how many hulls have a label", () => {
  it("is not known, rather than 0, while assets are still to be read", () => {
    const read = sampleCard({ labels: [0, 0, -1] });
    const coming = sampleCard({ asset: "b", hulls: null });
    expect(countLabels({ a: read, b: coming })).toBeNull();
    expect(countLabels({ a: read, b: { ...coming, error: "no mesh" } })?.get(0)).toBe(2);
    expect(countLabels({ a: read })?.get(1)).toBeUndefined();
  });
});
