import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { commandFor } from "../commands/all";
import { labelling } from "../commands/labelling";
import { api } from "../server/api";
import type { AnyEdit } from "../wire";
import { initialDesk, select, useDesk } from "./desk";
import { setLayout, useLayout } from "./layout";
import { emptyProject, receive, useProject } from "./project";
import { confirmLabels, goToUnsure } from "./queue";
import { sampleCard } from "./sample.test-help";
import { useScenes } from "./scenes";
import { useToasts } from "./toasts";

const hull = (name: string, label: string | null) => ({ name, label, confidence: 0.3, source: "propagated" });
const hulls = [hull("x", "leg"), hull("y", null), hull("z", "panel")];
const card = (asset: string, unsure: number[]) => sampleCard({ asset, hulls: 3, labels: [0, -1, 1], unsure });
let sent: AnyEdit[] = [];

/** Shows the asset in hand, as the page does once it was opened. */
const showOpen = () => useScenes.setState({ scene: { asset: useDesk.getState().asset, view: { hulls }, hulls } as never });
const press = async (key: string) => {
  showOpen();
  await commandFor(key, labelling)?.run();
  showOpen();
};
const inHand = () => [useDesk.getState().asset, ...useDesk.getState().selection];

beforeEach(() => {
  sent = [];
  const vocabulary = ["leg", "panel"].map((name) => ({ name, color: "#000000", used: 1 }));
  const cards = { a: card("a", [0]), b: card("b", [2, 0]), c: card("c", []) };
  useProject.setState(
    { ...emptyProject, order: ["a", "b", "c"], cards, project: { ...emptyProject.project, vocabulary } },
    true,
  );
  useDesk.setState({ ...initialDesk, asset: "a" }, true);
  useToasts.setState({ toasts: [] });
  showOpen();
  vi.spyOn(api, "edit").mockImplementation(async (edit) => (sent.push(edit), { said: "done", nothing: false }));
  vi.spyOn(api, "asset").mockResolvedValue({ hulls } as never);
  vi.spyOn(api, "shapes").mockResolvedValue({ header: { rows: [] }, rows: [], shapes: [] });
});
afterEach(() => vi.restoreAllMocks());

const toasts = () => useToasts.getState().toasts.map((toast) => toast.text);

describe("the queue of unsure hulls", () => {
  it("opens the asset of the next one, selects it and looks at it", async () => {
    select(["x"]);
    setLayout({ gallery: true });
    await goToUnsure();
    expect(inHand()).toEqual(["b", "x"]);
    expect(useLayout.getState().gallery).toBe(false);
    expect(useDesk.getState().cameraOrder).toEqual({ count: 1, to: "near" });
  });

  it("goes back with Shift+N", async () => {
    select(["x"]);
    await press("Shift+N");
    expect(inHand()).toEqual(["b", "z"]);
    await press("Shift+N");
    expect(inHand()).toEqual(["b", "x"]);
    await press("Shift+N");
    expect(inHand()).toEqual(["a", "x"]);
  });

  it("vouches for a label as it is, then goes on", async () => {
    select(["x"]);
    await confirmLabels();
    expect(sent).toEqual([{ kind: "label", asset: "a", hulls: ["x"], label: "leg" }]);
    expect(useDesk.getState().asset).toBe("b");
  });

  it("goes on when a digit labelled the hull that it put in hand", async () => {
    await press("N");
    await press("2");
    expect(sent).toEqual([{ kind: "label", asset: "a", hulls: ["x"], label: "panel" }]);
    expect(inHand()).toEqual(["b", "x"]);
  });

  it("leaves a person alone who labels another hull", async () => {
    await press("N");
    select(["y"]);
    await press("2");
    expect(inHand()).toEqual(["a", "y"]);
    select(["x", "y"]);
    await press("1");
    expect(useDesk.getState().asset).toBe("a");
  });

  it("stays with a hull whose label was taken away", async () => {
    await press("N");
    await press("0");
    expect(sent).toEqual([{ kind: "label", asset: "a", hulls: ["x"], label: null }]);
    expect(inHand()).toEqual(["a", "x"]);
  });

  it("passes over what was labelled though the cards do not tell it yet, and says when all are sure", async () => {
    for (const key of ["N", "1", "Enter", "2"]) await press(key);
    expect(sent.map((edit) => "hulls" in edit && [edit.asset, ...edit.hulls])).toEqual([["a", "x"], ["b", "x"], ["b", "z"]]);
    expect(inHand()).toEqual(["b", "z"]);
    expect(toasts()).toEqual(["Every label is sure."]);
  });

  it("takes up again what is unsure once more, as after undo", async () => {
    for (const key of ["N", "1"]) await press(key);
    receive({ kind: "cards", cards: [card("a", [0])], gone: [] });
    await press("Shift+N");
    expect(inHand()).toEqual(["a", "x"]);
  });

  it("stays where the label could not be given", async () => {
    vi.mocked(api.edit).mockRejectedValue(new Error("no"));
    await press("N");
    await press("2");
    expect(inHand()).toEqual(["a", "x"]);
  });
});
