import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { commandFor } from "../commands/list";
import { labelCommands } from "../commands/label";
import { api } from "../server/api";
import type { AnyEdit } from "../wire";
import { emptyProject, receive, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { useScenes } from "./scenes";
import { useToasts } from "./toasts";
import { confirmLabels, labelProgress, nextPlace, placeInWalk, queueOf, walk } from "./labelWalk";
import { initialWorkspace, select, setLayout, useLayout, useWorkspace } from "./workspace";

const card = (asset: string, labels: number[], confidence: number[]) => sampleCard({ asset, hulls: labels.length, labels, confidence });
const cards = { a: card("a", [0, -1], [101, -1]), b: card("b", [0, 1, 1], [80, 101, 30]), c: card("c", [1], [30]) };
const order = ["a", "b", "c"];
const place = (asset: string, position: number, sure: number) => ({ asset, position, sure });

describe("the walk through labels that nobody gave", () => {
  const queue = [place("a", 1, -1), place("b", 2, 30), place("c", 0, 30), place("b", 0, 80)];

  it("goes from the least sure to the surest, those alike in the order of the family", () => {
    expect(queueOf(cards, order)).toEqual(queue);
  });

  it("goes on and back along that order, and round", () => {
    const ahead = [null, ...queue].map((from) => nextPlace(queue, order, from));
    expect(ahead).toEqual([queue[0], queue[1], queue[2], queue[3], queue[0]]);
    const back = [null, ...queue].map((from) => nextPlace(queue, order, from, -1));
    expect(back).toEqual([queue[3], queue[3], queue[0], queue[1], queue[2]]);
  });

  it("goes on from where it was though that hull is labelled by now", () => {
    expect(nextPlace(queue.slice(1), order, queue[0] ?? null)).toEqual(queue[1]);
    expect(nextPlace([], order, queue[0] ?? null)).toBeNull();
  });

  it("says which place a hull has in it", () => {
    const own = ["x", "y", "z"].map((name) => ({ name }));
    useProject.setState({ order });
    expect(["x", "y", "z"].map((name) => placeInWalk(cards, "b", own, name))).toEqual([{ at: 3, of: 4 }, null, { at: 1, of: 4 }]);
  });
});

it("counts hulls with and without a label, and what was given and guessed", () => {
  expect(labelProgress(cards)).toEqual({ hulls: 6, labelled: 5, unsure: 2, guessed: 1, given: 2, assets: 2 });
});

const hull = (name: string, label: string | null) => ({ name, label, confidence: 0.3, source: "propagated", look: label && "unsure" });
const hulls = [hull("x", "leg"), hull("y", null), hull("z", "panel")];
const cardQueue = (asset: string, x: number, z: number) => sampleCard({ asset, hulls: 3, labels: [0, -1, 1], confidence: [x, 101, z] });
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
  const cards = { a: cardQueue("a", 20, 101), b: cardQueue("b", 30, 60), c: cardQueue("c", 101, 101) };
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

describe("the walk", () => {
  it("opens the asset of the next one, selects it and looks at it", async () => {
    select(["x"]);
    setLayout({ gallery: true });
    await walk();
    expect(inHand()).toEqual(["b", "x"]);
    expect(useLayout.getState().gallery).toBe(false);
    expect(useWorkspace.getState().cameraOrder).toEqual({ count: 1, to: "near" });
  });

  it("goes back with Shift+N", async () => {
    select(["x"]);
    for (const hull of [["b", "z"], ["b", "x"], ["a", "x"]]) {
      await press("Shift+N");
      expect(inHand()).toEqual(hull);
    }
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

  it("says when all are given", async () => {
    await press("N");
    await press("1");
    receive({ kind: "cards", cards: [cardQueue("a", 101, 101), cardQueue("b", 101, 101)], gone: [] });
    await press("N");
    expect(toasts()).toEqual(["Every label was given by you, a file or a name."]);
  });

  it("stays where the label could not be given", async () => {
    vi.mocked(api.edit).mockRejectedValue(new Error("no"));
    await press("N");
    await press("2");
    expect(inHand()).toEqual(["a", "x"]);
  });
});
