import { beforeEach, describe, expect, it } from "vitest";
import {
  hover,
  initialLayout,
  initialWorkspace,
  lookFrom,
  openAsset,
  openStage,
  select,
  selectMore,
  setBrush,
  setChecks,
  setDraft,
  setFilters,
  setHighlight,
  setLayout,
  setTool,
  setView,
  show,
  useLayout,
  useWorkspace,
  visit,
} from "./workspace";

const now = () => useWorkspace.getState();
const selected = () => [...now().selection].sort();
const draft = { name: "Merge", arguments: {}, each: false, label: null, editing: null };

/** Something of everything that belongs to one asset. */
function fillHands(): void {
  useWorkspace.setState({ asset: "a", selection: new Set(["x"]), hover: "x", hidden: new Set(["y"]), landmarks: ["x"], tool: "box", draft });
}

beforeEach(() => {
  useWorkspace.setState(initialWorkspace, true);
  useLayout.setState(initialLayout, true);
});

describe("going to another asset", () => {
  it("leaves behind what belongs to the one before", () => {
    fillHands();
    openAsset("b");
    const { asset, selection, hover: pointed, hidden, landmarks, tool } = now();
    expect([asset, selection.size, pointed, hidden.size, landmarks.length, tool, now().draft]).toEqual(["b", 0, null, 0, 0, "select", null]);
  });

  it("keeps stage, view and filters", () => {
    openStage("review");
    setView({ wireframe: true });
    setFilters({ search: "leg" });
    openAsset("b");
    expect([now().stage, now().view.wireframe, now().filters.search]).toEqual(["review", true, "leg"]);
  });

  it("changes nothing where it is open already", () => {
    fillHands();
    const before = now();
    openAsset("a");
    expect(now()).toBe(before);
  });
});

describe("going to another stage", () => {
  it("empties the hands, and keeps the asset and what is hidden", () => {
    fillHands();
    setBrush("leg");
    openStage("learn");
    expect([now().asset, [...now().hidden], now().tool, now().brush, now().draft, selected()]).toEqual(["a", ["y"], "select", null, null, []]);
  });

  it("changes nothing where it is open already", () => {
    fillHands();
    const before = now();
    openStage("label");
    expect(now()).toBe(before);
  });
});

describe("visiting an asset in a state", () => {
  it("shows that state with hulls selected, until another stage or asset is opened", () => {
    visit("b", { kind: "steps", steps: 2 }, ["x"]);
    expect([now().asset, now().showing, now().asked, selected()]).toEqual(["b", { kind: "steps", steps: 2 }, { kind: "steps", steps: 2 }, ["x"]]);
    openStage("learn");
    expect(now().asked).toBeNull();
    visit("b", { kind: "source" });
    openAsset("c");
    expect(now().asked).toBeNull();
  });

  it("leaves the hands alone where the asset is open already, but for the selection", () => {
    fillHands();
    visit("a", { kind: "source" });
    expect([now().draft, [...now().hidden], selected()]).toEqual([draft, ["y"], []]);
  });
});

describe("selecting", () => {
  it.each([
    ["replace", ["b"]],
    ["add", ["a", "b", "c"]],
    ["toggle", ["a", "b"]],
    ["subtract", ["a"]],
  ] as const)("can %s", (how, left) => {
    select(["a", "c"]);
    selectMore(how === "toggle" || how === "subtract" ? ["b", "c"] : ["b"], how);
    expect(selected()).toEqual(left);
  });

  it("twice by toggling is as before", () => {
    select(["a"]);
    selectMore(["a", "b"], "toggle");
    selectMore(["a", "b"], "toggle");
    expect(selected()).toEqual(["a"]);
  });

  it("gives a new set each time, so that who watches it knows", () => {
    const before = now().selection;
    select([]);
    expect(now().selection).not.toBe(before);
  });
});

describe("tools and what is pointed at", () => {
  it("forget landmarks when a tool is chosen", () => {
    useWorkspace.setState({ landmarks: ["x"] });
    setTool("landmark");
    expect([now().tool, now().landmarks]).toEqual(["landmark", []]);
  });

  it("change nothing while the pointer stays on the same hull", () => {
    hover("x");
    const before = now();
    hover("x");
    expect(now()).toBe(before);
    hover(null);
    expect(now().hover).toBeNull();
  });

  it("count each order to the camera", () => {
    lookFrom("fit");
    lookFrom("fit");
    expect(now().cameraOrder).toEqual({ count: 2, to: "fit" });
  });
});

describe("settings", () => {
  it("change one by one", () => {
    setView({ explode: 0.5 });
    setChecks({ engine: "unity" });
    setFilters({ only: ["failed"] });
    expect(now().view).toEqual({ ...initialWorkspace.view, explode: 0.5 });
    expect(now().checks).toEqual({ open: false, engine: "unity" });
    expect(now().filters).toEqual({ search: "", only: ["failed"], sort: "name" });
  });

  it("of the window are apart from those of the view", () => {
    setLayout({ gallery: true });
    expect(useLayout.getState()).toEqual({ ...initialLayout, gallery: true });
    expect(now()).toBe(initialWorkspace);
  });

  it("hold what is shown, in hand and pointed out", () => {
    show({ kind: "result", of: "output" });
    setDraft(draft);
    setHighlight({ what: "rule 1", assets: { a: [0] } });
    expect([now().showing, now().draft, now().highlight?.what]).toEqual([{ kind: "result", of: "output" }, draft, "rule 1"]);
  });
});
