// Which state of which asset is shown, as the person and the server go on.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { emptyProject, type ProjectState, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { followWorkspace, useScenes, waitForFirstScene } from "./scenes";
import { initialWorkspace, openAsset, openStage, show, useWorkspace, visit } from "./workspace";

const step = (error: string | null = null) => ({ rule: 1, select: ["x"], action: "Delete", error, made: [], removed: [] });
const edited = { header: { hulls: [], made: [], removed: [], contacts: [], rows: [] }, rows: [], shapes: [] };
let steps: ReturnType<typeof step>[] = [];
let stop: () => void = () => undefined;
let revision = 100;

const shown = () => {
  const { scene } = useScenes.getState();
  return scene && [scene.asset, scene.showing];
};
const settle = () => vi.waitFor(() => expect(useScenes.getState().loading).toBe(false));
const change = (state: Partial<ProjectState>) => useProject.setState(state);

beforeEach(() => {
  steps = [];
  revision += 10;
  const cards = Object.fromEntries(["a", "b", "c"].map((asset) => [asset, sampleCard({ asset })]));
  const revisions = { a: revision, b: revision, c: revision };
  useProject.setState({ ...emptyProject, cards, order: ["a", "b", "c"], revisions, shapeRevisions: revisions }, true);
  useWorkspace.setState(initialWorkspace, true);
  useScenes.setState({ scene: null, loading: false, problem: null });
  vi.spyOn(api, "asset").mockImplementation(async (asset) => ({ asset, hulls: [], non_convex: [], contacts: [], steps }) as never);
  vi.spyOn(api, "shapes").mockResolvedValue({ header: { rows: [] }, rows: [], shapes: [] });
  vi.spyOn(api, "stage").mockResolvedValue(edited as never);
  vi.spyOn(api, "result").mockResolvedValue(edited as never);
  stop = followWorkspace();
});

afterEach(() => {
  stop();
  vi.restoreAllMocks();
});

describe("what is shown of an asset", () => {
  it("is its own hulls while labels are given", async () => {
    openAsset("a");
    await vi.waitFor(() => expect(shown()).toEqual(["a", { kind: "source" }]));
  });

  it("is what its steps made of it while demonstrating", async () => {
    steps = [step(), step()];
    openStage("demonstrate");
    openAsset("a");
    await vi.waitFor(() => expect(shown()).toEqual(["a", { kind: "steps", steps: 2 }]));
  });

  it("ends before the step that cannot be done", async () => {
    steps = [step(), step("no such hull"), step()];
    openStage("demonstrate");
    openAsset("a");
    await vi.waitFor(() => expect(shown()).toEqual(["a", { kind: "steps", steps: 1 }]));
  });

  it("is the written output while reviewing, or what the program makes where nothing is written", async () => {
    const { cards } = useProject.getState();
    const output = sampleCard({ asset: "a", output: "edited", edited_picture: "v" });
    change({ cards: { ...cards, a: output }, program: { ...emptyProject.program, text: "p", version: "1" } });
    openStage("review");
    openAsset("a");
    await vi.waitFor(() => expect(shown()).toEqual(["a", { kind: "result", of: "output" }]));
    openAsset("b");
    await vi.waitFor(() => expect(shown()).toEqual(["b", { kind: "result", of: "program" }]));
  });

  it("is the original where the program fails on it", async () => {
    const reach = { a: { asset: "a", rules: [], error: "no handle" } };
    change({ program: { ...emptyProject.program, text: "p" }, reach: reach as never });
    openStage("learn");
    openAsset("a");
    await vi.waitFor(() => expect(shown()).toEqual(["a", { kind: "source" }]));
  });

  it("is what was asked for, as long as stage and asset stay", async () => {
    openAsset("a");
    await settle();
    steps = [step()];
    openStage("demonstrate");
    await vi.waitFor(() => expect(shown()?.[1]).toEqual({ kind: "steps", steps: 1 }));
    visit("b", { kind: "source" });
    await vi.waitFor(() => expect(shown()).toEqual(["b", { kind: "source" }]));
    openAsset("a");
    await vi.waitFor(() => expect(shown()).toEqual(["a", { kind: "steps", steps: 1 }]));
  });

  it("is another state as soon as the person chooses one", async () => {
    openAsset("a");
    await vi.waitFor(() => expect(shown()?.[0]).toBe("a"));
    show({ kind: "steps", steps: 1 });
    await vi.waitFor(() => expect(shown()?.[1]).toEqual({ kind: "steps", steps: 1 }));
  });
});

describe("news of the server", () => {
  it("opens the first asset that there is", async () => {
    change({ cards: { ...useProject.getState().cards } });
    await vi.waitFor(() => expect(useWorkspace.getState().asset).toBe("a"));
  });

  it("opens the asset that is next, where the server names one", async () => {
    change({ project: { ...emptyProject.project, next: { kind: "label", text: "", asset: "b", command: null, note: null } } });
    await vi.waitFor(() => expect(useWorkspace.getState().asset).toBe("b"));
  });

  it("opens another asset where the open one is gone", async () => {
    openAsset("b");
    const { a } = useProject.getState().cards;
    change({ cards: { a } as never, order: ["a"] });
    expect(useWorkspace.getState().asset).toBe("a");
    change({ cards: {}, order: [] });
    expect(useWorkspace.getState().asset).toBeNull();
  });

  it("fetches the open asset again when it changed, and no other", async () => {
    openAsset("a");
    await vi.waitFor(() => expect(shown()?.[0]).toBe("a"));
    await settle();
    const calls = () => vi.mocked(api.asset).mock.calls.filter(([asset]) => asset === "a").length;
    const before = calls();
    const { revisions } = useProject.getState();
    change({ revisions: { ...revisions, c: revision + 1 } });
    await settle();
    expect(calls()).toBe(before);
    change({ revisions: { ...revisions, a: revision + 1 } });
    await vi.waitFor(() => expect(calls()).toBe(before + 1));
  });

  it("fetches the result again when the program changed", async () => {
    change({ program: { ...emptyProject.program, text: "p", version: "1" } });
    openStage("learn");
    openAsset("a");
    await vi.waitFor(() => expect(shown()?.[1]).toEqual({ kind: "result", of: "program" }));
    await settle();
    const before = vi.mocked(api.result).mock.calls.length;
    change({ program: { ...emptyProject.program, text: "q", version: "2" } });
    await vi.waitFor(() => expect(vi.mocked(api.result).mock.calls.length).toBe(before + 1));
  });

  it("is followed no longer once the returned function was called", async () => {
    openAsset("a");
    await vi.waitFor(() => expect(shown()?.[0]).toBe("a"));
    stop();
    openAsset("b");
    await Promise.resolve();
    expect(shown()?.[0]).toBe("a");
  });
});

it("fetches the assets beside the open one ahead of time", async () => {
  openAsset("b");
  await vi.waitFor(() => expect(vi.mocked(api.asset).mock.calls.map(([asset]) => asset).sort()).toEqual(["a", "b", "c"]));
});

it("says when the first scene is shown", async () => {
  vi.stubGlobal("requestAnimationFrame", (draw: () => void) => draw());
  let there = false;
  void waitForFirstScene().then(() => (there = true));
  await Promise.resolve();
  expect(there).toBe(false);
  openAsset("a");
  await vi.waitFor(() => expect(there).toBe(true));
  vi.unstubAllGlobals();
});
