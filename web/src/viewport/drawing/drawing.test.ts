// Three.js objects of the picture: what they hold, without drawing them.
import { BufferGeometry, Color, type InstancedBufferGeometry, LineSegments, Mesh, type ShaderMaterial, Vector3 } from "three";
import { beforeEach, describe, expect, it } from "vitest";
import { box, boxScene, stubBrowser } from "../stage/boxes.test-help";
import { edgesOf } from "../geometry/edges";
import { AssetDrawing, extentOf, pointsOf } from "./assetDrawing";
import { ContactGraph } from "./contactGraph";
import { CutPlaneDrawing } from "./cutPlane";
import { Ground, niceStep } from "./ground";
import { HullSet } from "./hullSet";
import { ByteTable, ROLE } from "./hullShader";
import { hullsToRemove, PreviewHulls } from "./previewHulls";
import { linesBetween, Strokes } from "./strokes";
import { Surfaces } from "./surface";
import { readThemeColors, type ThemeColors } from "./themeColors";

const boxes = [box("a", [0, 0, 0]), box("b", [2, 0, 0], [1, 2, 3])];
const FRAME = { width: 400, height: 300, pixel: 2, explode: 0, eye: { at: [9, 8, 7], parallel: false } } as const;
const plain = { color: new Color("#102030"), fill: "solid" as const, visible: true, selected: 0, hover: 0, role: ROLE.plain };
let ink: ThemeColors;

/** The faces, and the lines, that an object holds. */
const meshIn = ({ children }: { children: readonly object[] }): Mesh => children.find((one) => one instanceof Mesh) as Mesh;
const linesIn = ({ children }: { children: readonly object[] }): LineSegments => children.find((one) => one instanceof LineSegments) as LineSegments;

beforeEach(() => {
  stubBrowser();
  ink = readThemeColors();
});

describe("a set of hulls", () => {
  it("knows for each vertex which hull it belongs to, and where that drifts", () => {
    const { geometry } = meshIn(new HullSet(boxes, [1, 1, 1], ink).object);
    const owner = [...(geometry.getAttribute("owner").array as Float32Array)];
    const away = geometry.getAttribute("away");
    expect(new Set(owner)).toEqual(new Set([0, 1]));
    const last = owner.lastIndexOf(1);
    expect([away.getX(0), away.getY(0), away.getZ(0)]).toEqual([-0.5, -0.5, -0.5]);
    expect([away.getX(last), away.getY(last), away.getZ(last)]).toEqual([1.5, 0, 0.5]);
  });

  it("has a triangle for each of its hulls' triangles", () => {
    const { geometry } = meshIn(new HullSet(boxes, [0, 0, 0], ink).object);
    expect(geometry.index?.count).toBe(2 * 36);
  });

  it("draws sharp edges, and as a wireframe all edges and no faces", () => {
    const hulls = new HullSet(boxes, [0, 0, 0], ink);
    const [faces, lines] = [meshIn(hulls.object), linesIn(hulls.object)];
    expect([hulls.sharpEdges, faces.visible, lines.geometry.drawRange.count]).toEqual([24, true, 48]);
    hulls.setWireframe(true, false);
    expect([faces.visible, lines.visible, lines.geometry.drawRange.count]).toEqual([false, true, Infinity]);
    hulls.setWireframe(false, true);
    expect([faces.visible, lines.visible]).toEqual([true, false]);
  });

  it("outlines hulls that are known and in sight only", () => {
    const hulls = new HullSet(boxes, [0, 0, 0], ink);
    hulls.paint((k) => ({ ...plain, visible: k === 1 }));
    expect(hulls.outlines(["a", "b", "c"])).toHaveLength(1);
    expect(hulls.outlines(["b"])[0]?.records).toBe(hulls.outlines(hulls.names)[0]?.records);
  });

  it("moves a hull from the centre as far as the view is pulled apart", () => {
    const hulls = new HullSet(boxes, [1, 0, 0], ink);
    expect(hulls.middle(0, 0)).toEqual([0.5, 0.5, 0.5]);
    expect(hulls.middle(0, 2)).toEqual([-0.5, 1.5, 1.5]);
  });

  it("writes colours and states as bytes, a row of the texture after the other", () => {
    const table = new ByteTable(300, true);
    table.set(257, 1, 2, 3, 4);
    const { data, width, height } = table.texture.image as { data: Uint8Array; width: number; height: number };
    expect([width, height, [...data.subarray(4 * 257, 4 * 258)]]).toEqual([256, 2, [1, 2, 3, 4]]);
  });
});

describe("one side of the picture", () => {
  it("takes over a scene of the same shapes, and no other", () => {
    const scene = boxScene(boxes);
    const side = new AssetDrawing(scene, [0, 0, 0], ink);
    expect(side.adopt({ ...scene, hulls: scene.hulls.map((hull) => ({ ...hull, label: "leg" })) })).toBe(true);
    expect(side.adopt(boxScene([boxes[0] as never]))).toBe(false);
    expect(side.adopt(boxScene([box("a", [0, 0, 0]), box("b", [2, 0, 0], [1, 2, 3])]))).toBe(false);
    expect(side.adopt({ ...scene, view: { ...scene.view, upright: [0, 1, 2] } })).toBe(false);
  });

  it("reaches round hulls and non-convex pieces", () => {
    const piece = { ...box("shell", [-4, 0, 0]), reason: "not convex" };
    expect(extentOf(boxScene(boxes))).toEqual([0, 0, 0, 3, 2, 3]);
    expect(extentOf(boxScene(boxes, { opaque: [piece] as never }))).toEqual([-4, 0, 0, 3, 2, 3]);
    expect(extentOf(boxScene([]))).toBeNull();
  });

  it("has its points where they are shown: in sight, apart, and upright", () => {
    const upright = [1, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
    const scene = boxScene(boxes);
    const side = new AssetDrawing({ ...scene, view: { ...scene.view, upright } }, [0, 0, 0], ink);
    const lowest = (points: readonly (readonly number[])[], axis: number) => Math.min(...points.map((point) => point[axis] ?? 0));
    expect(pointsOf(side, null, 0)).toHaveLength(16);
    expect(pointsOf(side, new Set(["b"]), 0)).toHaveLength(8);
    expect(lowest(pointsOf(side, new Set(["b"]), 0), 0)).toBe(12);
    expect(lowest(pointsOf(side, new Set(["b"]), 1), 0)).toBe(14.5);
    side.hulls.visible[0] = false;
    expect(pointsOf(side, null, 0)).toHaveLength(8);
  });
});

describe("strokes", () => {
  const strokes = () => new Strokes(new Color("red"), { width: 2, dash: 5, behind: 0.3 });
  const countOf = (one: Strokes) => (meshIn(one.object).geometry as InstancedBufferGeometry).instanceCount;

  it("are there only where there is something to draw", () => {
    const one = strokes();
    expect(one.object.visible).toBe(false);
    one.set(linesBetween([[[0, 0, 0], [1, 0, 0]]]));
    expect(one.object.visible).toBe(true);
    one.set([]);
    expect(one.object.visible).toBe(false);
  });

  it("are as many as the lines", () => {
    const one = strokes();
    one.set(linesBetween([[[0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 1, 0]]]));
    one.measure(FRAME);
    expect(countOf(one)).toBe(2);
  });

  it("of a hull are its silhouette, which is another one from another side", () => {
    const one = strokes();
    one.set([{ records: edgesOf((boxes[0] as (typeof boxes)[number]).shape).records, away: [0, 0, 0] }]);
    one.measure(FRAME);
    expect(countOf(one)).toBe(6);
    one.measure({ ...FRAME, eye: { at: [0.5, 0.4, 9], parallel: false } });
    expect(countOf(one)).toBe(4);
  });

  it("that no section plane cuts share no program with those that it cuts, as that keeps the plane", () => {
    const [cut, whole] = [true, false].map((is) => meshIn(new Strokes(ink.text, { width: 1, cut: is }).object).material as ShaderMaterial);
    expect([cut?.clipping, cut?.defines, whole?.clipping, whole?.defines]).toEqual([true, { CUT: 1 }, false, {}]);
    expect(whole?.fragmentShader.replaceAll(/\s+/g, " ")).toContain("#ifdef CUT clip(); #endif");
  });

  it("are as wide on the screen whatever the pixels", () => {
    const one = strokes();
    one.measure(FRAME);
    const { uniforms } = meshIn(one.object).material as never as { uniforms: Record<string, { value: unknown }> };
    expect([uniforms["width"]?.value, uniforms["dash"]?.value]).toEqual([4, 10]);
  });
});

describe("the action in hand", () => {
  const [a, b] = boxes as [(typeof boxes)[number], (typeof boxes)[number]];
  const packet = (made: string[], hulls: string[]) =>
    ({ header: { made, hulls: hulls.map((name) => ({ name })) }, rows: [{ name: "a" }, { name: "b" }], shapes: [a.shape, b.shape] }) as never;

  it("shows what it makes, and not what stays", () => {
    const preview = new PreviewHulls(packet(["b"], ["a", "b"]), [0, 0, 0], ink);
    const faces = meshIn(preview.object.children[0] as never);
    expect(faces.geometry.index?.count).toBe(36);
  });

  it("removes what is not left, and what it makes anew", () => {
    expect([...hullsToRemove(packet(["b"], ["b", "c"]), ["a", "b", "c"])]).toEqual(["a", "b"]);
    expect(hullsToRemove(null, ["a"]).size).toBe(0);
  });
});

describe("the cutting plane", () => {
  const shape = (boxes[1] as (typeof boxes)[number]).shape;
  const plane = { hull: "b", at: [2.5, 1, 1.5], across: [0, 0, 1], span: 3 } as never;

  it("lies through its point, across its direction, and is larger than the hull", () => {
    const drawing = new CutPlaneDrawing(ink);
    drawing.set(plane, shape, [0, 0, 0]);
    const { geometry } = meshIn(drawing.object);
    const at = geometry.getAttribute("position");
    const corners = [0, 1, 2, 3].map((k) => new Vector3().fromBufferAttribute(at as never, k));
    for (const corner of corners) expect(corner.z).toBeCloseTo(1.5, 6);
    const [xs, ys] = [corners.map(({ x }) => x), corners.map(({ y }) => y)];
    expect([Math.min(...xs) < 2, Math.max(...xs) > 3, Math.min(...ys) < 0, Math.max(...ys) > 2]).toEqual([true, true, true, true]);
  });

  it("goes where the exploded view has moved the hull, and away without one", () => {
    const drawing = new CutPlaneDrawing(ink);
    drawing.set(plane, shape, [1, 2, 3]);
    expect([drawing.object.visible, drawing.object.position.toArray()]).toEqual([true, [1, 2, 3]]);
    drawing.set(null, shape, [0, 0, 0]);
    expect(drawing.object.visible).toBe(false);
  });
});

describe("the ground", () => {
  it("lies below the asset, with steps that suit its size", () => {
    const ground = new Ground();
    ground.fit([0, 0, 2, 7, 7, 9], ink);
    expect(ground.step).toBe(1);
    ground.fit([0, 0, 0, 0.07, 0.07, 0.02], ink);
    expect(ground.step).toBeCloseTo(0.01, 9);
    const lines = linesIn(ground.scene.children[0] as never);
    lines.geometry.computeBoundingBox();
    expect(lines.geometry.boundingBox?.max.z).toBeLessThan(0);
  });

  it("is made anew for another asset, not in addition", () => {
    const ground = new Ground();
    for (const size of [1, 2, 3]) ground.fit([0, 0, 0, size, size, size], ink);
    expect(ground.scene.children[0]?.children).toHaveLength(2);
  });

  it("has steps of one, two or five", () => {
    expect([0.9, 1, 1.9, 2.1, 4.9, 7, 30].map(niceStep).map((step) => Number(step.toPrecision(6)))).toEqual([0.5, 1, 1, 2, 2, 5, 20]);
  });
});

it("the contact graph has strong, weak and dashed lines apart, and a dot for each hull", () => {
  const graph = new ContactGraph(ink);
  const line = (strong: boolean, touching: boolean) => ({ a: [0, 0, 0] as const, b: [1, 0, 0] as const, strong, touching });
  graph.set([{ at: [0, 0, 0], strong: false }, { at: [1, 0, 0], strong: true }], [line(true, true), line(false, true), line(false, false)]);
  const groups = graph.object.children.filter((one) => !("geometry" in one));
  expect(groups.map(({ visible }) => visible)).toEqual([true, true, true, false]);
  const dots = graph.object.children.find((one) => "geometry" in one) as unknown as { geometry: BufferGeometry };
  expect([...(dots.geometry.getAttribute("strong").array as Float32Array)]).toEqual([0, 1]);
});

it("surfaces are denser where one points at them", () => {
  const surfaces = new Surfaces(boxes, new Color("grey"), 0.3);
  const opacity = (k: number) => ((surfaces.object.children[k] as Mesh).material as never as { uniforms: { opacity: { value: number } } }).uniforms.opacity.value;
  surfaces.point("b");
  expect(opacity(1)).toBeGreaterThan(opacity(0));
  surfaces.point(null);
  expect(opacity(1)).toBe(opacity(0));
});
