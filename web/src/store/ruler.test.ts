// What the ruler measures, in the axes of the asset as it is shown, and how it is told.
import { beforeEach, describe, expect, it } from "vitest";
import { box, boxScene } from "../viewport/stage/boxes.test-help";
import { clearMeasures, initialRuler, measureExtents, measureText, removeMeasure, takePoint, useRuler } from "./ruler";
import type { Scene } from "./scenes";

const scene = boxScene([box("a", [0, 0, 0], [1, 2, 3]), box("b", [4, 0, 0])]);
/** The same, turned so that its y points up. */
const turned: Scene = { ...scene, view: { ...scene.view, upright: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1] } };
const point = (hull: string, at: [number, number, number]) => ({ hull, at, snap: "corner" as const });
const measures = () => useRuler.getState().measures;

beforeEach(() => useRuler.setState(initialRuler, true));

describe("two points", () => {
  it("make a measure, with its parts along the axes", () => {
    takePoint(scene, point("a", [1, 2, 3]));
    expect(measures()).toEqual([]);
    takePoint(scene, point("b", [4, 0, -3]));
    expect(measures()).toMatchObject([{ asset: "a", length: 7, along: [3, 2, 6] }]);
    expect(useRuler.getState().first).toBeNull();
  });

  it("are told along the axes as the asset is shown", () => {
    takePoint(turned, point("a", [0, 0, 0]));
    takePoint(turned, point("b", [3, 2, 6]));
    expect(measures()).toMatchObject([{ length: 7, along: [3, 6, 2] }]);
  });

  it("have the length that their parts have", () => {
    takePoint(turned, point("a", [0.1, -0.7, 0.35]));
    takePoint(turned, point("b", [-3, 2.25, 6]));
    const [{ length, along } = { length: 0, along: [] }] = measures();
    expect(Math.hypot(...along)).toBeCloseTo(length ?? 0, 9);
  });
});

describe("extents", () => {
  it("are those of one hull or of several, along the axes as shown", () => {
    expect(measureExtents(scene, new Set(["a"]))).toMatchObject({ what: "Extents of a", along: [1, 2, 3], length: null });
    expect(measureExtents(turned, new Set(["a"]))).toMatchObject({ along: [1, 3, 2] });
    expect(measureExtents(scene, new Set(["a", "b"]))).toMatchObject({ what: "Extents of 2 hulls", along: [5, 2, 3] });
    expect(measureExtents(scene, new Set(["gone"]))).toBeNull();
  });

  it("are drawn from one corner of the box", () => {
    const lines = measureExtents(turned, new Set(["a"]))?.lines.map(({ ends }) => ends);
    expect(new Set(lines?.map(([from]) => String(from))).size).toBe(1);
    expect(lines?.map(([from, to]) => Math.hypot(...to.map((value, k) => value - (from[k] ?? 0))))).toEqual([1, 3, 2]);
  });
});

describe("measures", () => {
  const line = { ends: [[0, 0, 0], [1, 0, 0]], hulls: ["", ""] } as const;
  const some = (asset: string, id: number) => ({ id, asset, what: "Distance", lines: [line as never], length: 1, along: [1, 0, 0] as [number, number, number] });

  it("stay until they are cleared, each or all of an asset", () => {
    useRuler.setState({ measures: [some("a", 1), some("a", 2), some("b", 3)] });
    removeMeasure(1);
    expect(measures().map(({ id }) => id)).toEqual([2, 3]);
    clearMeasures("a");
    expect(measures().map(({ id }) => id)).toEqual([3]);
  });

  it("are told in the chosen unit, all as fine as four digits of the largest", () => {
    expect(measureText({ length: 0.1745, along: [0.1745, 2.442e-5, 1.1e-5] }, "m").along).toBe("dx 0.1745 · dy 0 · dz 0 m");
    expect(measureText({ length: 0.1745, along: [0.1745, 2.442e-4, 1.1e-5] }, "mm").along).toBe("dx 174.5 · dy 0.2 · dz 0 mm");
    expect(measureText({ length: 0.123456, along: [0.1, 0.05, 0] }, "m")).toEqual({ main: "0.1235 m", along: "dx 0.1 · dy 0.05 · dz 0 m" });
    expect(measureText({ length: 0.123456, along: [0.1, 0.05, 0] }, "mm").main).toBe("123.5 mm");
    expect(measureText({ length: null, along: [1, 2, 3] }, "mm")).toEqual({ main: "x 1,000 · y 2,000 · z 3,000 mm", along: "" });
    expect(measureText({ length: 0, along: [0, 0, 0] }, "mm").main).toBe("0 mm: they touch");
  });
});
