// What was measured in the view: from point to point, the gap between two hulls, the extents of some. It stays until it
// is cleared, and belongs to the asset that it was measured on.
import { create } from "zustand";
import { axisInFile } from "./cut";
import type { Scene } from "./scenes";
import { lengthNumbers, type LengthUnit } from "./units";
import { dot, minus, plus, spanAlong, type Triple } from "./vectors";

/** A point on a hull; at: in the frame of the file, where the hull is without the exploded view. */
export interface RulerPoint {
  readonly hull: string;
  readonly at: Triple;
  readonly snap: "corner" | "edge" | "face";
}

/** A line with the hulls that its ends are on, empty for none: the exploded view moves them along. */
export interface RulerLine {
  readonly ends: readonly [Triple, Triple];
  readonly hulls: readonly [string, string];
}

export interface Measure {
  readonly id: number;
  readonly asset: string;
  /** What was measured: `Distance`, `Gap a – b`, `Extents of a`. */
  readonly what: string;
  readonly lines: readonly RulerLine[];
  /** Null where only the extents along the axes were measured [m]. */
  readonly length: number | null;
  /** Along the axes of the asset as it is shown [m]. */
  readonly along: Triple;
}

interface RulerState {
  /** The first of two points. */
  readonly first: RulerPoint | null;
  /** The point under the pointer. */
  readonly pointed: RulerPoint | null;
  readonly measures: readonly Measure[];
}

export const initialRuler: RulerState = { first: null, pointed: null, measures: [] };
export const useRuler = create<RulerState>()(() => initialRuler);

export const pointRuler = (pointed: RulerPoint | null): void => useRuler.setState({ pointed });

/** Takes a point: the first one, or the second, which ends the measure. */
export function takePoint(scene: Scene, point: RulerPoint): void {
  const { first } = useRuler.getState();
  if (!first) return useRuler.setState({ first: point });
  useRuler.setState({ first: null });
  addMeasure(measureBetween(scene, first, point));
}

/** Puts the ruler down; what was measured stays. */
export const dropPoints = (): void => useRuler.setState({ first: null, pointed: null });

export function addMeasure(measure: Omit<Measure, "id">): void {
  useRuler.setState(({ measures }) => ({ measures: [...measures, { ...measure, id: 1 + (measures.at(-1)?.id ?? 0) }] }));
}

export function removeMeasure(id: number): void {
  useRuler.setState(({ measures }) => ({ measures: measures.filter((one) => one.id !== id) }));
}

export function clearMeasures(asset: string): void {
  useRuler.setState(({ measures }) => ({ measures: measures.filter((one) => one.asset !== asset), first: null }));
}

export function measureBetween(scene: Scene, a: RulerPoint, b: RulerPoint): Omit<Measure, "id"> {
  return lineMeasure(scene, "Distance", { ends: [a.at, b.at], hulls: [a.hull, b.hull] });
}

/** The gap between two hulls, given where they are nearest to each other. */
export function measureGap(scene: Scene, names: readonly [string, string], ends: readonly [Triple, Triple]): Omit<Measure, "id"> {
  return lineMeasure(scene, `Gap between ${names[0]} and ${names[1]}`, { ends, hulls: names });
}

function lineMeasure(scene: Scene, what: string, line: RulerLine): Omit<Measure, "id"> {
  const [a, b] = line.ends;
  const across = minus(b, a);
  const along = AXES.map((axis) => Math.abs(dot(across, axisInFile(scene.view, axis)))) as Triple;
  return { asset: scene.asset, what, lines: [line], length: Math.hypot(...across), along };
}

/** How far hulls reach along the axes, with the three edges of the box around them. */
export function measureExtents(scene: Scene, names: ReadonlySet<string>): Omit<Measure, "id"> | null {
  const hulls = scene.hulls.filter((hull) => names.has(hull.name));
  const [first] = hulls;
  if (!first) return null;
  const axes = AXES.map((axis) => axisInFile(scene.view, axis));
  const spans = axes.map((axis) => spanAlong(hulls.map((hull) => hull.shape.positions), axis));
  const lows = spans.map(([low]) => low);
  const corner = [0, 1, 2].map((k) => axes.reduce((sum, axis, a) => sum + (lows[a] ?? 0) * (axis[k] ?? 0), 0)) as Triple;
  const along = spans.map(([low, high]) => high - low) as Triple;
  const on = hulls.length === 1 ? first.name : "";
  const lines = axes.map((axis, a): RulerLine => {
    return { ends: [corner, plus(corner, axis, along[a])], hulls: [on, on] };
  });
  const what = hulls.length === 1 ? `Extents of ${first.name}` : `Extents of ${hulls.length} hulls`;
  return { asset: scene.asset, what, lines, length: null, along };
}

const AXES = ["x", "y", "z"] as const;

/** A measure in words, as its label and a screen reader have it. */
export function measureText({ length, along }: Pick<Measure, "length" | "along">, unit: LengthUnit): { main: string; along: string } {
  const [all = "", ...parts] = lengthNumbers([length ?? 0, ...along], unit);
  const told = parts.map((part, k) => `${length === null ? "" : "d"}${AXES[k] ?? ""} ${part}`).join(" · ");
  if (length === null) return { main: `${told} ${unit}`, along: "" };
  return { main: length === 0 ? `0 ${unit}: they touch` : `${all} ${unit}`, along: `${told} ${unit}` };
}
