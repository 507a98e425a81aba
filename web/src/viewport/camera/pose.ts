// Where one looks from: a point, a direction and a size, the same for perspective and parallel projection.
import { minus, plus, type Vec } from "../../store/vectors";
import type { StandardView } from "../../store/workspace";

/**
 * target: what one looks at; azimuth, elevation: of the eye as seen from there; height: of the picture there [m]; shift:
 * where in the picture the target is, from its middle to the right and up, in heights of the picture.
 */
export interface Pose {
  readonly target: Vec;
  readonly azimuth: number;
  readonly elevation: number;
  readonly height: number;
  readonly shift: readonly [number, number];
}

export const FIELD = (32 * Math.PI) / 180;
const QUARTER = Math.PI / 2;

export const START: Pose = { target: [0, 0, 0], azimuth: -0.95, elevation: 0.42, height: 2, shift: [0, 0] };

export const STANDARD: Readonly<Record<StandardView, { azimuth: number; elevation: number }>> = {
  front: { azimuth: -QUARTER, elevation: 0 },
  back: { azimuth: QUARTER, elevation: 0 },
  right: { azimuth: 0, elevation: 0 },
  left: { azimuth: Math.PI, elevation: 0 },
  top: { azimuth: -QUARTER, elevation: QUARTER },
  bottom: { azimuth: -QUARTER, elevation: -QUARTER },
  iso: { azimuth: START.azimuth, elevation: START.elevation },
};

/** The axes of the picture: right, up, and towards the eye. */
export function axesOf({ azimuth, elevation }: Pose): { right: Vec; up: Vec; eye: Vec } {
  const [c, s] = [Math.cos(azimuth), Math.sin(azimuth)];
  const [ce, se] = [Math.cos(elevation), Math.sin(elevation)];
  return { right: [-s, c, 0], up: [-se * c, -se * s, ce], eye: [ce * c, ce * s, se] };
}

/** How far the eye is away in perspective. */
export const distanceOf = ({ height }: Pose): number => height / 2 / Math.tan(FIELD / 2);

/** Turned by an angle sideways and up; never over the pole. */
export function orbit(pose: Pose, sideways: number, up: number): Pose {
  const elevation = Math.min(QUARTER, Math.max(-QUARTER, pose.elevation + up));
  return { ...pose, azimuth: pose.azimuth + sideways, elevation };
}

/** Moved so that what was in the middle is that much of the height to the right and up. */
export function pan(pose: Pose, right: number, up: number): Pose {
  const axes = axesOf(pose);
  const target = plus(plus(pose.target, axes.right, -right * pose.height), axes.up, -up * pose.height);
  return { ...pose, target };
}

/** Nearer by a factor below 1; what is under a point, given in heights from where the target is, stays there. */
export function zoom(pose: Pose, factor: number, right: number, up: number, limits: readonly [number, number]): Pose {
  const height = Math.min(limits[1], Math.max(limits[0], pose.height * factor));
  const kept = pose.height - height;
  const axes = axesOf(pose);
  const target = plus(plus(pose.target, axes.right, right * kept), axes.up, up * kept);
  return { ...pose, target, height };
}

/** Seen from a standard side; what is in the middle and how large it is stay. */
export function lookFromSide(pose: Pose, side: StandardView): Pose {
  return { ...pose, ...STANDARD[side] };
}

/** Between two poses; the shorter way round. */
export function interpolate(a: Pose, b: Pose, share: number): Pose {
  const turn = ((((b.azimuth - a.azimuth + Math.PI) % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) - Math.PI;
  return {
    target: plus(a.target, minus(b.target, a.target), share),
    azimuth: a.azimuth + turn * share,
    elevation: a.elevation + (b.elevation - a.elevation) * share,
    height: a.height * (b.height / a.height) ** share,
    shift: [a.shift[0] + (b.shift[0] - a.shift[0]) * share, a.shift[1] + (b.shift[1] - a.shift[1]) * share],
  };
}

/** The corners of a box given by its lowest and highest corner. */
export function cornersOf(box: readonly number[]): Vec[] {
  return Array.from({ length: 8 }, (_, k) => [box[k & 1 ? 3 : 0] ?? 0, box[k & 2 ? 4 : 1] ?? 0, box[k & 4 ? 5 : 2] ?? 0]);
}
