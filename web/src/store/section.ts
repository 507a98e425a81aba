// The section plane: what lies before it is out of sight, so that one sees inside. It changes nothing of the asset; the
// plane that cuts a hull in two is in `cut.ts`.
import { create } from "zustand";
import { type Axis, negative, type Triple } from "./vectors";

export type SectionAxis = Axis | "view";

interface SectionState {
  readonly on: boolean;
  readonly axis: SectionAxis;
  /** Of length one in the canonical frame, towards the side that is out of sight unless it is flipped. */
  readonly across: Triple;
  /** Where the plane is, from one end of the asset (0) to the other (1). */
  readonly share: number;
  readonly flipped: boolean;
}

/** The side that is out of sight is the one that the usual view looks at: right, front, top. */
const AXES: Readonly<Record<Axis, Triple>> = { x: [1, 0, 0], y: [0, -1, 0], z: [0, 0, 1] };

export const initialSection: SectionState = { on: false, axis: "x", across: AXES.x, share: 0.5, flipped: false };
export const useSection = create<SectionState>()(() => initialSection);

export function setSection(change: Partial<Pick<SectionState, "on" | "share" | "flipped">>): void {
  const { share } = { ...useSection.getState(), ...change };
  useSection.setState({ ...change, share: Math.min(1, Math.max(0, share)) });
}

const Y_UP = { x: "x", y: "z", z: "y" } as const;

/** Puts the plane across an axis, through the middle; yUp: whether Y is shown as up. */
export function sectionAlong(axis: Axis, yUp = false): void {
  useSection.setState({ on: true, axis, across: AXES[yUp ? Y_UP[axis] : axis], share: 0.5, flipped: false });
}

/** Puts the plane across the line of sight; eye: where one looks from, of length one. */
export function sectionFacing(eye: Triple): void {
  useSection.setState({ on: true, axis: "view", across: eye, share: 0.5, flipped: false });
}

/** What is out of sight: all points whose product with the normal is above `at` [m]. */
export interface SectionPlane {
  readonly normal: Triple;
  readonly at: number;
}

/** The plane in a box of all that is shown, given by its lowest and highest corner; null where there is none. */
export function sectionPlane(box: readonly number[], { on, across, share, flipped }: SectionState): SectionPlane | null {
  if (!on) return null;
  const [low, high] = spanOfBox(box, across);
  const at = low + share * (high - low);
  return flipped ? { normal: negative(across), at: -at } : { normal: across, at };
}

/** From where to where a box reaches in a direction. */
export function spanOfBox(box: readonly number[], across: Triple): [low: number, high: number] {
  let [low, high] = [0, 0];
  across.forEach((value, axis) => {
    const ends = [value * (box[axis] ?? 0), value * (box[axis + 3] ?? 0)];
    low += Math.min(...ends);
    high += Math.max(...ends);
  });
  return [low, high];
}
