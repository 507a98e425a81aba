// Keys that label.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { emptyProject, useProject } from "../store/project";
import { sampleCard } from "../store/sample.test-help";
import { useScenes } from "../store/scenes";
import { useToasts } from "../store/toasts";
import { initialWorkspace, select, setBrush, useWorkspace } from "../store/workspace";
import type { AnyEdit } from "../wire";
import { labelCommands } from "./label";
import { commandFor } from "./list";

const command = (key: string) => commandFor(key, labelCommands);
const press = (key: string) => command(key)?.run();
const hulls = ["x", "y"].map((name, k) => ({ name, label: k ? "leg" : null, confidence: null, source: null, look: k ? "unsure" : null }));
let sent: AnyEdit[] = [];

beforeEach(() => {
  sent = [];
  const vocabulary = ["leg", "top"].map((name) => ({ name, text: name, color: "#000000", used: 0, is_class: false }));
  const cards = { a: sampleCard({ asset: "a", hulls: 2, labels: [-1, -1] }) };
  useProject.setState({ ...emptyProject, order: ["a"], cards, project: { ...emptyProject.project, vocabulary } }, true);
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useScenes.setState({ scene: { asset: "a", hulls, view: { hulls } } as never });
  useToasts.setState({ toasts: [] });
  vi.spyOn(api, "edit").mockImplementation(async (edit) => (sent.push(edit), { message: "", nothing: true }));
});

afterEach(() => {
  vi.restoreAllMocks();
});

describe("a digit", () => {
  it("labels the selection with the label in that place", async () => {
    select(["y"]);
    press("2");
    await vi.waitFor(() => expect(sent).toEqual([{ kind: "label", hulls: { a: ["y"] }, label: "top" }]));
  });

  it("labels or paints, never both: painting begins with nothing selected, and a selection ends it", () => {
    press("1");
    expect(useWorkspace.getState().brush).toBe("leg");
    select(["y"]);
    expect(useWorkspace.getState().brush).toBeNull();
    press("1");
    expect([useWorkspace.getState().brush, useWorkspace.getState().selection.size]).toEqual([null, 1]);
    setBrush("top");
    expect([useWorkspace.getState().brush, useWorkspace.getState().selection.size]).toEqual(["top", 0]);
  });

  it("arms the brush where nothing is selected, and disarms it the second time", () => {
    press("1");
    expect(useWorkspace.getState().brush).toBe("leg");
    press("2");
    expect(useWorkspace.getState().brush).toBe("top");
    press("2");
    expect(useWorkspace.getState().brush).toBeNull();
  });

  it("means nothing beyond the list of labels, and in other stages says what it is for", () => {
    expect(command("3")).toBeUndefined();
    useWorkspace.setState({ stage: "learn" });
    expect(command("1")).toBeUndefined();
    select(["y"]);
    for (const key of ["2", "0", "P"]) press(key);
    expect(useToasts.getState().toasts.map(({ text }) => text)).toEqual([
      "2 gives the label top in the Label stage (Alt+1).",
      "0 removes labels in the Label stage (Alt+1).",
      "P labels all hulls in the Label stage (Alt+1).",
    ]);
    expect([sent, useWorkspace.getState().brush]).toEqual([[], null]);
  });
});

describe("nought", () => {
  it("removes the label, or arms a brush that does", async () => {
    press("0");
    expect(useWorkspace.getState().brush).toBe("");
    select(["x"]);
    press("0");
    await vi.waitFor(() => expect(sent).toEqual([{ kind: "label", hulls: { a: ["x"] }, label: null }]));
    expect(useWorkspace.getState().brush).toBeNull();
  });
});

describe("Escape", () => {
  it("stops painting, and means nothing otherwise", () => {
    expect(command("Escape")).toBeUndefined();
    press("1");
    press("Escape");
    expect(useWorkspace.getState().brush).toBeNull();
  });
});

describe("P", () => {
  it("labels all hulls, or says why it cannot", async () => {
    const started = vi.spyOn(api, "startJob").mockResolvedValue({ id: "1" } as never);
    await press("P");
    expect(useToasts.getState().toasts.map(({ text }) => text)).toEqual(["Label the hulls of one asset first."]);
    expect(started).not.toHaveBeenCalled();
    useProject.setState({ cards: { a: sampleCard({ asset: "a", hulls: 2, labels: [0, -1], confidence: [101, -1] }) } });
    await press("P");
    expect(started).toHaveBeenCalledWith({ kind: "label" });
  });
});

describe("hulls whose label nobody gave", () => {
  const unsure = { cards: { a: sampleCard({ asset: "a", labels: [-1, 0], confidence: [-1, 30] }) } };

  it("have keys in this stage only", () => {
    useProject.setState(unsure);
    expect([command("N")?.id, command("Shift+N")?.id]).toEqual(["label-next", "label-previous"]);
    useWorkspace.setState({ stage: "learn" });
    expect(command("N")).toBeUndefined();
  });

  it("are confirmed by Enter only where one of them is selected that has a label", () => {
    useProject.setState(unsure);
    select(["x"]);
    expect(command("Enter")).toBeUndefined();
    select(["x", "y"]);
    expect(command("Enter")?.id).toBe("label-right");
    useProject.setState({ cards: { a: sampleCard({ asset: "a", labels: [-1, 0], confidence: [-1, 101] }) } });
    expect(command("Enter")).toBeUndefined();
    useWorkspace.setState({ asset: "b" });
    expect(command("Enter")).toBeUndefined();
  });
});
