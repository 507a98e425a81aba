// The plane along which a hull is to be cut, in the frame that the asset comes in.
import { create } from "zustand";
import type { CutHull } from "../wire";
import { perform } from "./edits";
import { type Scene, type SceneHull, useScenes } from "./scenes";
import { type Axis, axisShown, dot, plus, spanAlong, type Triple } from "./vectors";
import { setTool, useWorkspace } from "./workspace";

export type CutAxis = "x" | "y" | "z" | "free";

interface CutState {
  readonly axis: CutAxis;
  /** Where the plane is, from one end of the hull (0) to the other (1). */
  readonly share: number;
  /** What a plane that was drawn freely lies across; null until one is drawn. */
  readonly drawn: Triple | null;
}

export const initialCut: CutState = { axis: "x", share: 0.5, drawn: null };
export const useCut = create<CutState>()(() => initialCut);

const NEAREST = 0.02;

export function setCut(change: Partial<CutState>): void {
  const { share } = { ...useCut.getState(), ...change };
  useCut.setState({ ...change, share: Math.min(1 - NEAREST, Math.max(NEAREST, share)) });
}

export interface CutPlane {
  readonly hull: string;
  readonly at: Triple;
  /** A direction of length one. */
  readonly across: Triple;
  /** How far the hull reaches along it [m]. */
  readonly span: number;
}

/** The hull that is to be cut: the one that is selected, if the asset has it as it comes. */
export function hullToCut(scene: Scene | null, selection: ReadonlySet<string>): SceneHull | null {
  const [name, ...others] = selection;
  if (others.length) return null;
  return scene?.hulls.find((hull) => hull.name === name && !hull.made) ?? null;
}

/** The plane through a hull; null while a free one is not drawn. */
export function planeOf(scene: Scene, hull: SceneHull, { axis, share, drawn }: CutState): CutPlane | null {
  const across = axis === "free" ? drawn : axisInFile(scene.view, axis);
  if (!across) return null;
  const [low, high] = spanAlong([hull.shape.positions], across);
  const middle = middleOf(hull.shape.positions);
  const off = low + share * (high - low) - dot(middle, across);
  const at = plus(middle, across, off);
  return { hull: hull.name, at, across, span: high - low };
}

/** Where along a hull a plane through a point is, 0 to 1. */
export function shareAt(hull: SceneHull, across: Triple, point: Triple): number {
  const [low, high] = spanAlong([hull.shape.positions], across);
  return (dot(point, across) - low) / (high - low || 1);
}

/** The direction of an axis as rules name it, in the frame of the file. */
export function axisInFile({ upright, y_up }: Pick<Scene["view"], "upright" | "y_up">, axis: Axis): Triple {
  const shown = axisShown(axis, y_up);
  return upright ? ([0, 1, 2].map((c) => shown.reduce((sum, value, k) => sum + value * (upright[4 * k + c] ?? 0), 0)) as Triple) : shown;
}

/** Cuts the selected hull along the plane, and puts the tool down. */
export async function performCut(): Promise<void> {
  const { scene } = useScenes.getState();
  const hull = hullToCut(scene, useWorkspace.getState().selection);
  const plane = scene && hull ? planeOf(scene, hull, useCut.getState()) : null;
  if (!scene || !plane) return;
  const edit: CutHull = { kind: "cut", asset: scene.asset, hull: plane.hull, at: plane.at, across: plane.across };
  if (await perform(edit)) leaveCut();
}

export function leaveCut(): void {
  useCut.setState(initialCut);
  if (useWorkspace.getState().tool === "cut") setTool("select");
}

function middleOf(positions: Float32Array): Triple {
  const middle = (across: Triple): number => {
    const [low, high] = spanAlong([positions], across);
    return (low + high) / 2;
  };
  return [middle([1, 0, 0]), middle([0, 1, 0]), middle([0, 0, 1])];
}
