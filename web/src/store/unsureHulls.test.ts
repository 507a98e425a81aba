
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { commandFor } from "../commands/list";
import { labelCommands } from "../commands/label";
import { api } from "../server/api";
import type { AnyEdit } from "../wire";
import { emptyProject, receive, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { useScenes } from "./scenes";
import { useToasts } from "./toasts";
import { confirmLabels, givenLabels, goToUnsure, labelProgress, nextUnsure } from "./unsureHulls";
import { initialWorkspace, select, setLayout, useLayout, useWorkspace } from "./workspace";

const card = (asset: string, labels: number[], unsure: number[]) =>
  sampleCard({ asset, hulls: labels.length, labels, unsure });
const cards = { a: card("a", [0, -1], []), b: card("b", [0, 1, 1], [2, 0]), c: card("c", [1], [0]) };
const order = ["a", "b", "c"];

describe("the queue of unsure hulls", () => {
  it("goes from hull to hull, asset to asset, and round", () => {
    const walked = [null, { asset: "b", position: 0 }, { asset: "b", position: 2 }, { asset: "c", position: 0 }].map(
      (from) => nextUnsure(cards, order, from),
    );
    expect(walked).toEqual([
      { asset: "b", position: 0 },
      { asset: "b", position: 2 },
      { asset: "c", position: 0 },
      { asset: "b", position: 0 },
    ]);
  });

  it("begins on the asset in hand where nothing is selected there", () => {
    expect(nextUnsure(cards, order, { asset: "c", position: -1 })).toEqual({ asset: "c", position: 0 });
  });

  it("goes back, and round the other way", () => {
    const walked = [{ asset: "c", position: 0 }, { asset: "b", position: 2 }, { asset: "b", position: 0 }, null].map(
      (from) => nextUnsure(cards, order, from, -1),
    );
    expect(walked).toEqual([
      { asset: "b", position: 2 },
      { asset: "b", position: 0 },
      { asset: "c", position: 0 },
      { asset: "c", position: 0 },
    ]);
  });

  it("goes back to the asset before where nothing is selected", () => {
    expect(nextUnsure(cards, order, { asset: "c", position: -1 }, -1)).toEqual({ asset: "b", position: 2 });
  });

  it("is empty where all are sure", () => {
    expect(nextUnsure({ a: cards.a }, ["a"], null)).toBeNull();
  });
});

it("counts hulls with and without a label", () => {
  expect(labelProgress(cards)).toEqual({ hulls: 6, labelled: 5, unsure: 3, assets: 2 });
});

it("counts hulls that people and files labelled", () => {
  const given = { a: { ...cards.a, given: 1 }, b: { ...cards.b, given: 3 }, c: cards.c };
  expect(givenLabels(given)).toEqual({ hulls: 6, given: 4, assets: 2 });
});

const hull = (name: string, label: string | null) => ({ name, label, confidence: 0.3, source: "propagated" });
const hulls = [hull("x", "leg"), hull("y", null), hull("z", "panel")];
const cardQueue = (asset: string, unsure: number[]) => sampleCard({ asset, hulls: 3, labels: [0, -1, 1], unsure });
let sent: AnyEdit[] = [];

/** Shows the asset in hand, as the page does once it was opened. */
const showOpen = () => useScenes.setState({ scene: { asset: useWorkspace.getState().asset, view: { hulls }, hulls } as never });
const press = async (key: string) => {
  showOpen();
  await commandFor(key, labelCommands)?.run();
  showOpen();
};
const inHand = () => [useWorkspace.getState().asset, ...useWorkspace.getState().selection];

beforeEach(() => {
  sent = [];
  const vocabulary = ["leg", "panel"].map((name) => ({ name, text: name, color: "#000000", used: 1, is_class: false }));
  const cards = { a: cardQueue("a", [0]), b: cardQueue("b", [2, 0]), c: cardQueue("c", []) };
  useProject.setState(
    { ...emptyProject, order: ["a", "b", "c"], cards, project: { ...emptyProject.project, vocabulary } },
    true,
  );
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useToasts.setState({ toasts: [] });
  showOpen();
  vi.spyOn(api, "edit").mockImplementation(async (edit) => (sent.push(edit), { message: "done", nothing: false }));
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
    expect(useWorkspace.getState().cameraOrder).toEqual({ count: 1, to: "near" });
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
    expect(sent).toEqual([{ kind: "label", hulls: { a: ["x"] }, label: "leg" }]);
    expect(useWorkspace.getState().asset).toBe("b");
  });

  it("goes on when a digit labelled the hull that it put in hand", async () => {
    await press("N");
    await press("2");
    expect(sent).toEqual([{ kind: "label", hulls: { a: ["x"] }, label: "panel" }]);
    expect(inHand()).toEqual(["b", "x"]);
  });

  it("leaves a person alone who labels another hull", async () => {
    await press("N");
    select(["y"]);
    await press("2");
    expect(inHand()).toEqual(["a", "y"]);
    select(["x", "y"]);
    await press("1");
    expect(useWorkspace.getState().asset).toBe("a");
  });

  it("stays with a hull whose label was taken away", async () => {
    await press("N");
    await press("0");
    expect(sent).toEqual([{ kind: "label", hulls: { a: ["x"] }, label: null }]);
    expect(inHand()).toEqual(["a", "x"]);
  });

  it("passes over what was labelled though the cards do not tell it yet, and says when all are sure", async () => {
    for (const key of ["N", "1", "Enter", "2"]) await press(key);
    expect(sent.map((edit) => edit.kind === "label" && edit.hulls)).toEqual([{ a: ["x"] }, { b: ["x"] }, { b: ["z"] }]);
    expect(inHand()).toEqual(["b", "z"]);
    expect(toasts()).toEqual(["No unsure label is left."]);
  });

  it("takes up again what is unsure once more, as after undo", async () => {
    for (const key of ["N", "1"]) await press(key);
    receive({ kind: "cards", cards: [cardQueue("a", [0])], gone: [] });
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
