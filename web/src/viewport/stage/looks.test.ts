// What decides how hulls look: selection, pointer, preview, rules, and comparison.
import { beforeEach, describe, expect, it } from "vitest";
import { usePreview } from "../../store/preview";
import { emptyProject, useProject } from "../../store/project";
import { initialWorkspace, setHighlight, useWorkspace } from "../../store/workspace";
import { hullLooks } from "../drawing/hullLooks";
import { ROLE } from "../drawing/hullShader";
import { readThemeColors } from "../drawing/themeColors";
import { box, boxScene, stageOf, stubBrowser } from "./boxes.test-help";
import { useRegion } from "./regionStore";
import { appearances, graphOf, showsPreview } from "./looks";

const boxes = [box("a", [0, 0, 0]), box("b", [2, 0, 0]), box("c", [4, 0, 0])];
const scene = boxScene(boxes);
const preview = (hulls: string[], made: string[]) => ({ header: { hulls: hulls.map((name) => ({ name })), made }, rows: [], shapes: [] }) as never;

function looks(of = scene): Record<string, ReturnType<typeof hullLooks>[number]> {
  const { shown } = appearances(of, readThemeColors());
  return Object.fromEntries(hullLooks(of, shown).map((look, k) => [of.hulls[k]?.name ?? "", look]));
}

beforeEach(() => {
  stubBrowser();
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useProject.setState(emptyProject, true);
  usePreview.setState({ preview: null });
  useRegion.setState({ drawn: [], region: new Set() });
});

describe("a hull", () => {
  it("looks selected, pointed at and hidden, each on its own", () => {
    useWorkspace.setState({ selection: new Set(["a"]), hover: "b", hidden: new Set(["c"]) });
    const { a, b, c } = looks();
    expect([a?.selected, b?.selected]).toEqual([1, 0]);
    expect([a?.hover, b?.hover]).toEqual([0, 1]);
    expect([a?.visible, c?.visible]).toEqual([true, false]);
  });

  it("is lit by a region that is drawn over it, less than by the pointer", () => {
    useRegion.setState({ region: new Set(["a"]) });
    useWorkspace.setState({ hover: "b" });
    expect(looks()["a"]?.hover).toBeGreaterThan(0);
    expect(looks()["a"]?.hover).toBeLessThan(looks()["b"]?.hover ?? 0);
  });

  it("is lit by a rule that selects it, and so is what was made of it", () => {
    const made = boxScene([box("a~1", [0, 0, 0]), box("b", [2, 0, 0])]);
    const hulls = made.hulls.map((hull) => (hull.name === "a~1" ? { ...hull, parent: "a" } : hull));
    setHighlight({ what: "rule 1", assets: { a: [0] } });
    const now = looks({ ...made, view: scene.view, hulls });
    expect(now["a~1"]?.hover).toBeGreaterThan(0);
    expect(now["b"]?.hover).toBe(0);
  });

  it("is grey without a label, and has the colour of its label with one", () => {
    const vocabulary = [{ name: "leg", text: "leg", color: "#ff0000", used: 1, is_class: false }];
    useProject.setState({ project: { ...emptyProject.project, vocabulary } });
    const hulls = scene.hulls.map((hull, k) => (k === 0 ? { ...hull, label: "leg", confidence: 0.2, look: "unsure" as const } : hull));
    const now = looks({ ...scene, hulls });
    expect(now["a"]?.color.getHexString()).toBe("ff0000");
    expect(now["a"]?.fill).toBe("hatched");
    expect(now["b"]?.color).toEqual(readThemeColors().unlabelled);
  });
});

describe("the action in hand", () => {
  it("marks what it would remove, or make anew under the same name", () => {
    usePreview.setState({ preview: preview(["b", "c"], ["c"]) });
    const now = looks();
    expect([now["a"]?.role, now["b"]?.role, now["c"]?.role]).toEqual([ROLE.removed, ROLE.plain, ROLE.removed]);
  });

  it("marks nothing on the side of the original", () => {
    usePreview.setState({ preview: preview([], []) });
    const { before } = appearances(scene, readThemeColors());
    expect(before.going.size).toBe(0);
  });

  it("is not shown while hulls are picked for something else", () => {
    usePreview.setState({ preview: preview([], []) });
    useWorkspace.setState({ tool: "cut" });
    expect(looks()["a"]?.role).toBe(ROLE.plain);
    expect((["select", "box", "lasso", "cut", "landmark"] as const).filter(showsPreview)).toEqual(["select", "box", "lasso"]);
  });
});

describe("comparing", () => {
  const edited = { ...scene, edit: { made: ["a"], removed: ["x"] } as never };

  it("pales what the edit left as it was", () => {
    useWorkspace.setState(({ view }) => ({ view: { ...view, compare: "side" } }));
    expect([looks(edited)["a"]?.role, looks(edited)["b"]?.role]).toEqual([ROLE.plain, ROLE.washed]);
  });

  it("pales nothing where nothing is compared, or nothing was changed", () => {
    expect(looks(edited)["b"]?.role).toBe(ROLE.plain);
    useWorkspace.setState(({ view }) => ({ view: { ...view, compare: "side" } }));
    expect(looks({ ...scene, edit: { made: [], removed: [] } as never })["b"]?.role).toBe(ROLE.plain);
  });
});

describe("the contact graph", () => {
  const near = [{ a: "b", b: "c", gap: 0.002 }];
  const touching = { ...scene, contacts: [["a", "b"]] as never, view: { ...scene.view, near_misses: near } as never };
  const graph = (explode = 0) => {
    const side = stageOf(touching).shown;
    if (!side) throw new Error("nothing is shown");
    return graphOf(side, explode);
  };

  it("has a dot for each hull, and a line for each contact and each near miss", () => {
    const { nodes, lines } = graph();
    expect(nodes).toHaveLength(3);
    expect(lines.map(({ touching: is }) => is)).toEqual([true, false]);
    expect(lines[0]?.a).toEqual([0.5, 0.5, 0.5]);
  });

  it("writes a gap only where one of its hulls is selected or pointed at", () => {
    expect(graph().gaps).toEqual([]);
    useWorkspace.setState({ hover: "c" });
    expect(graph().gaps).toEqual([{ at: [3.5, 0.5, 0.5], gap: 0.002 }]);
    expect(graph().lines.map(({ strong }) => strong)).toEqual([false, true]);
  });

  it("leaves out what is hidden", () => {
    useWorkspace.setState({ hidden: new Set(["b"]) });
    const { nodes, lines } = graph();
    expect([nodes.length, lines.length]).toEqual([2, 0]);
  });

  it("goes apart with the hulls", () => {
    const far = (explode: number) => Math.abs((graph(explode).lines[0]?.a[0] ?? 0) - (graph(explode).lines[0]?.b[0] ?? 0));
    expect(far(1)).toBeGreaterThan(far(0));
  });
});
