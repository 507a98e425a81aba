// Commands that go somewhere.
import { beforeEach, expect, test, vi } from "vitest";
import { api } from "../server/api";
import { useCalls } from "../store/calls";
import { useDecompose } from "../store/decompose";
import { useLabelSources } from "../store/labelSources";
import { nextText } from "../store/nextStep";
import { emptyProject, useProject } from "../store/project";
import { sampleCard } from "../store/sample.test-help";
import { initialLayout, initialWorkspace, openAsset, openStage, setBrush, useLayout, useWorkspace, visit } from "../store/workspace";
import type { NextStep } from "../wire";
import { commandFor } from "./list";
import { goCommands } from "./navigate";

vi.mock("../store/edits", () => ({ undo: vi.fn(), redo: vi.fn(), perform: vi.fn(), pendingEdits: vi.fn(), sendAfterEdits: (request: () => Promise<unknown>) => request() }));

const plain = sampleCard({ hulls: 1, labels: [0] });
const run = (key: string) => commandFor(key, goCommands)?.run();
const asset = () => useWorkspace.getState().asset;

const setNext = (kind: NextStep["kind"], to: string | null = null) =>
  useProject.setState((state) => ({ project: { ...state.project, next: { kind, text: "Look.", asset: to, command: null, note: null } } }));

beforeEach(() => {
  const cards = [plain, { ...plain, asset: "b", confidence: [20] }, { ...plain, asset: "c" }];
  useProject.setState({ ...emptyProject, cards: Object.fromEntries(cards.map((card) => [card.asset, card])), order: ["a", "b", "c"] });
  useWorkspace.setState({ ...initialWorkspace, asset: "a" });
  useLayout.setState(initialLayout);
});

test("Tab and Shift+Tab walk through the assets that are shown", () => {
  run("Tab");
  expect(asset()).toBe("b");
  run("Shift+Tab");
  run("Shift+Tab");
  expect(asset()).toBe("c");
  useWorkspace.setState({ asset: "a", filters: { ...initialWorkspace.filters, search: "c" } });
  run("Tab");
  expect(asset()).toBe("c");
});

test("N goes to the next asset that wants to be looked at, where no stage has a queue of its own", () => {
  expect(commandFor("N", goCommands)).toBeUndefined();
  useWorkspace.setState({ stage: "learn" });
  run("N");
  expect(asset()).toBe("b");
  expect(commandFor("N", goCommands)).toBeUndefined();
});

test("Alt and a digit go to a stage", () => {
  run("Alt+3");
  expect(useWorkspace.getState().stage).toBe("learn");
});

test("what is next is one key away", () => {
  setNext("review", "c");
  run("Alt+Enter");
  expect([useWorkspace.getState().stage, asset()]).toEqual(["review", "c"]);
});

test.each([
  ["apply", "apply"], ["export", "export"], ["answer", "card"], ["demonstrate", null],
] as const)("a step to %s calls for its place", (kind, place) => {
  useCalls.setState({ place: null });
  setNext(kind);
  run("Alt+Enter");
  expect(useCalls.getState().place).toBe(place);
});

test("a step to decompose asks how, beside the first asset that has none", () => {
  useProject.setState({ cards: { a: plain, b: sampleCard({ asset: "b", hulls: 0, sources: 1 }) } });
  setNext("decompose");
  run("Alt+Enter");
  expect([useDecompose.getState().open, asset()]).toEqual(["b", "b"]);
});

test("a step to label-all is done at once, unless it is being done", async () => {
  const started = vi.spyOn(api, "startJob").mockResolvedValue({} as never);
  useProject.setState({ cards: { b: sampleCard({ asset: "b", hulls: 2, labels: [0, -1], confidence: [101, -1] }) } });
  useLabelSources.setState({ files: 1 });
  setNext("label-all");
  expect(nextText(useProject.getState())).toBe("Look.");
  await run("Alt+Enter");
  await vi.waitFor(() => expect(started).toHaveBeenCalledOnce());
  useProject.setState({ jobs: [{ id: "1", kind: "label", title: "Look.", done: 3, total: 9, doing: "", left: null, state: "running", message: "", lines: [], out: null }] });
  await run("Alt+Enter");
  expect([started.mock.calls.length, nextText(useProject.getState())]).toEqual([1, "Look.: 3 of 9"]);
});

test("undo is there only if there is something to undo", () => {
  expect(commandFor("Ctrl+Z", goCommands)).toBeUndefined();
  useProject.setState({ history: { undo: "Delete", redo: null, undoable: 1, redoable: 0 } });
  expect(commandFor("Ctrl+Z", goCommands)?.id).toBe("undo");
  expect(commandFor("Ctrl+Y", goCommands)).toBeUndefined();
});

test("the same key opens and closes help", () => {
  run("?");
  expect(useWorkspace.getState().overlay).toBe("help");
  run("?");
  expect(useWorkspace.getState().overlay).toBe("none");
});

test("themes come round", () => {
  const theme = goCommands.find((command) => command.id === "theme");
  const seen = [0, 1, 2].map(() => {
    theme?.run();
    return useWorkspace.getState().theme;
  });
  expect(seen).toEqual(["light", "dark", "system"]);
});

test("Q lets the family fill the centre and gives it back", () => {
  run("Q");
  expect(useLayout.getState().gallery).toBe(true);
  run("Q");
  expect(useLayout.getState().gallery).toBe(false);
});

test.each([
  ["a stage in which one selects hulls", () => openStage("demonstrate")],
  ["a hull that a card shows", () => visit("a", { kind: "source" }, ["x"])],
  ["painting", () => setBrush("leg")],
])("%s gives the view back", (_, act) => {
  openStage("review");
  run("Q");
  openAsset("a");
  expect(useLayout.getState().gallery).toBe(true);
  act();
  expect(useLayout.getState().gallery).toBe(false);
});
