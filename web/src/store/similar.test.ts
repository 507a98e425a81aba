// Look-alikes: what is asked, how the answer is selected on shown and other assets, and asking again for more.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { selectCommands } from "../commands/select";
import { api } from "../server/api";
import type { AnyEdit, SimilarView } from "../wire";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { useScenes } from "./scenes";
import { selectSimilar, useSimilar } from "./similar";
import { applyLabel } from "./labelWalk";
import { useToasts } from "./toasts";
import { initialWorkspace, openAsset, openStage, select, selectMore, showSheet, useWorkspace } from "./workspace";

const hulls = ["x", "y", "z"].map((name) => ({ name, label: null }));
const answer = (found: Record<string, string[]>, more = true, step = 0): SimilarView => ({
  found: Object.entries(found).map(([asset, names]) => ({ asset, hulls: names, positions: names.map((_, k) => k) })),
  step,
  more,
  unread: [],
  passed_over: 0,
});
const selected = () => [...useWorkspace.getState().selection].sort();
const elsewhere = () => Object.fromEntries(useWorkspace.getState().elsewhere);

beforeEach(() => {
  const cards = Object.fromEntries(["a", "b", "c"].map((asset) => [asset, sampleCard({ asset, hulls: 3 })]));
  useProject.setState({ ...emptyProject, cards, order: ["a", "b", "c"] }, true);
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useScenes.setState({ scene: { asset: "a", hulls, view: { hulls } } as never });
  useSimilar.setState({ last: null, searching: false });
  vi.spyOn(api, "similar").mockResolvedValue(answer({ a: ["x", "y"], b: ["u"], c: ["v", "w"] }));
});
afterEach(() => {
  vi.restoreAllMocks();
});

describe("look-alikes on all assets", () => {
  it("are selected where they are shown and elsewhere", async () => {
    select(["x"]);
    await selectSimilar("everywhere");
    expect(vi.mocked(api.similar).mock.calls[0]?.[0]).toEqual({ hulls: [{ asset: "a", hull: "x" }], assets: ["a", "b", "c"], step: 0 });
    expect([selected(), elsewhere()]).toEqual([["x", "y"], { b: ["u"], c: ["v", "w"] }]);
  });

  it("are not looked for in more assets than there is time for, and the person is told so", async () => {
    vi.mocked(api.similar).mockResolvedValue({ ...answer({ a: ["x", "y"] }), passed_over: 9600 });
    select(["x"]);
    await selectSimilar("everywhere");
    expect(useToasts.getState().toasts.at(-1)?.text).toBe("9,600 assets were not looked in, as there are too many: filter the family to look in others.");
  });

  it("are asked for in the next step by the same key, from what one began with, as long as nothing was changed", async () => {
    select(["x"]);
    await selectSimilar("everywhere");
    await selectSimilar("everywhere");
    expect(vi.mocked(api.similar).mock.calls[1]?.[0]).toMatchObject({ hulls: [{ hull: "x" }], step: 1 });
    selectMore(["y"], "toggle");
    await selectSimilar("everywhere");
    expect(vi.mocked(api.similar).mock.calls[2]?.[0]).toMatchObject({ step: 0 });
    expect(vi.mocked(api.similar).mock.calls[2]?.[0].hulls.length).toBe(4);
  });

  it("stay selected while one looks at another asset, and are there on coming back", async () => {
    select(["x"]);
    await selectSimilar("everywhere");
    openAsset("c");
    expect([selected(), elsewhere()]).toEqual([["v", "w"], { a: ["x", "y"], b: ["u"] }]);
    selectMore(["w"], "toggle");
    openAsset("a");
    expect([selected(), elsewhere()]).toEqual([["x", "y"], { b: ["u"], c: ["v"] }]);
  });

  it("come into one view and go out of it with their selection", async () => {
    select(["x"]);
    await selectSimilar("everywhere");
    showSheet(["a", "b"]);
    expect([selected(), elsewhere()]).toEqual([["u · b", "x · a", "y · a"], { c: ["v", "w"] }]);
    showSheet(["a"]);
    expect([selected(), elsewhere()]).toEqual([["x", "y"], { b: ["u"], c: ["v", "w"] }]);
  });

  it("are labelled by one edit", async () => {
    const sent: AnyEdit[] = [];
    vi.spyOn(api, "edit").mockImplementation(async (edit) => (sent.push(edit), { message: "", nothing: true }));
    select(["x"]);
    await selectSimilar("everywhere");
    applyLabel("leg");
    const hulls = { a: ["x", "y"], b: ["u"], c: ["v", "w"] };
    await vi.waitFor(() => expect(sent).toEqual([{ kind: "label", hulls, label: "leg" }]));
  });

  it("are selected no more after a plain click, another stage, or Escape", async () => {
    for (const leave of [() => select(["z"]), () => openStage("learn"), () => selectCommands.find(({ id }) => id === "select-none")?.run()]) {
      useWorkspace.setState({ stage: "label" });
      select(["x"]);
      await selectSimilar("everywhere");
      expect(useWorkspace.getState().elsewhere.size).toBe(2);
      leave();
      expect(elsewhere()).toEqual({});
    }
  });
});

describe("look-alikes of this asset", () => {
  it("are added; hidden ones are not, nor is an answer that comes after another selection", async () => {
    useWorkspace.setState({ hidden: new Set(["y"]) });
    select(["x"]);
    await selectSimilar("here");
    expect(vi.mocked(api.similar).mock.calls[0]?.[0].assets).toBeNull();
    expect(selected()).toEqual(["x"]);
    const asked = selectSimilar("here");
    select(["z"]);
    await asked;
    expect(selected()).toEqual(["z"]);
  });
});
