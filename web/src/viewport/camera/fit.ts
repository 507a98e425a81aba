// Which pose shows all of some points within a rectangle of the picture, and which rectangle what lies over the view
// leaves free.
import { dot, ORIGIN, plus, rangeOf, type Vec } from "../../store/vectors";
import { axesOf, FIELD, type Pose } from "./pose";

/** A rectangle of the picture, y downwards [px]. */
export interface Rect {
  readonly left: number;
  readonly top: number;
  readonly right: number;
  readonly bottom: number;
}

/** A part of a picture: its middle, from that of the picture to the right and up, and its sizes, all in heights of it. */
export interface Room {
  readonly at: readonly [right: number, up: number];
  readonly width: number;
  readonly height: number;
}

/** All of a picture of that width over height. */
export const wholeRoom = (aspect: number): Room => ({ at: [0, 0], width: aspect, height: 1 });

const MARGIN = 1.12;
/** How high the picture is at least at the target, in how much less it is at what is nearest to the eye. */
const CLEAR = 1.3;

/** Shows all of some points in a room, from the same side, in its middle. */
export function fit(pose: Pose, points: readonly Vec[], room: Room, perspective: boolean): Pose {
  const axes = axesOf(pose);
  const [right, up, eye] = [axes.right, axes.up, axes.eye].map((axis) => points.map((p) => dot(p, axis))) as [number[], number[], number[]];
  const slope = perspective ? 2 * Math.tan(FIELD / 2) : 0;
  const e = midrange(eye);
  const [wide, high] = [room.width / 2 / MARGIN, room.height / 2 / MARGIN];
  const across = { places: right, near: eye.map((at) => slope * (at - e)), half: wide };
  const upward = { places: up, near: across.near, half: high };
  const clear = CLEAR * across.near.reduce((most, lost) => Math.max(most, lost), 0);
  const height = Math.max(heightFor(across), heightFor(upward), clear, 1e-6);
  const target = plus(plus(plus(ORIGIN, axes.right, middleFor(across, height)), axes.up, middleFor(upward, height)), axes.eye, e);
  return { ...pose, target, height, shift: room.at };
}

/** One direction of the picture. near: how much less high the picture is at each point than at the target [m]. */
interface Span {
  readonly places: readonly number[];
  readonly near: readonly number[];
  /** Half of the room, in heights. */
  readonly half: number;
}

/** The least height at which all can be within the room: then two of them touch its sides. */
function heightFor({ places, near, half }: Span): number {
  let [most, least] = [-Infinity, Infinity];
  places.forEach((at, k) => {
    const lost = half * (near[k] ?? 0);
    most = Math.max(most, at + lost);
    least = Math.min(least, at - lost);
  });
  return (most - least) / (2 * half);
}

const ROUNDS = 5;

/** Where the target is to be so that what is seen reaches as far to both sides (Newton's method). */
function middleFor({ places, near }: Span, height: number): number {
  let middle = midrange(places);
  for (let round = 0; round < ROUNDS; round++) {
    let [most, least] = [-Infinity, Infinity];
    let [steep, flat] = [0, 0];
    places.forEach((at, k) => {
      const scale = 1 / Math.max(height - (near[k] ?? 0), 1e-9 * height);
      const seen = (at - middle) * scale;
      if (seen > most) [most, steep] = [seen, scale];
      if (seen < least) [least, flat] = [seen, scale];
    });
    middle += (most + least) / (steep + flat);
  }
  return middle;
}

/** Halfway between the lowest and the highest. */
function midrange(values: readonly number[]): number {
  const [low, high] = rangeOf(values);
  return (low + high) / 2;
}

/** What is seen of points, width over height. */
export function shapeOf(pose: Pose, points: readonly Vec[]): number {
  const axes = axesOf(pose);
  const reach = (axis: Vec) => {
    const [low, high] = rangeOf(points.map((p) => dot(p, axis)));
    return high - low;
  };
  return Math.max(reach(axes.right), 1e-9) / Math.max(reach(axes.up), 1e-9);
}

/** Less than this share of the size it could have in the whole picture is too small; then overlays are overlooked. */
const LEAST = 0.4;
/** What being away from the middle of the picture costs, for all of its size. */
const ASIDE = 0.5;

/** The part of a picture that no rectangle covers in which something of a shape (width over height) is largest. */
export function freeRoom(width: number, height: number, covers: readonly Rect[], shape: number): Room {
  const seen = covers
    .map((one) => ({ left: Math.max(0, one.left), top: Math.max(0, one.top), right: Math.min(width, one.right), bottom: Math.min(height, one.bottom) }))
    .filter((one) => one.left < one.right && one.top < one.bottom);
  const size = ({ left, top, right, bottom }: Rect) => Math.min((right - left) / shape, bottom - top);
  const aside = ({ left, top, right, bottom }: Rect) => Math.abs(left + right - width) / width + Math.abs(top + bottom - height) / height;
  const worth = (one: Rect) => size(one) * (1 - (ASIDE / 2) * aside(one));
  const whole = { left: 0, top: 0, right: width, bottom: height };
  let best: Rect | null = null;
  for (const left of [0, ...seen.map((one) => one.right)]) {
    for (const right of [width, ...seen.map((one) => one.left)]) {
      for (const top of [0, ...seen.map((one) => one.bottom)]) {
        for (const bottom of [height, ...seen.map((one) => one.top)]) {
          const one = { left, top, right, bottom };
          if (left >= right || top >= bottom || (best && worth(one) <= worth(best)) || seen.some((cover) => meet(cover, one))) continue;
          best = one;
        }
      }
    }
  }
  const { left, top, right, bottom } = best && size(best) >= LEAST * size(whole) ? best : whole;
  return {
    at: [((left + right) / 2 - width / 2) / height, (height / 2 - (top + bottom) / 2) / height],
    width: (right - left) / height,
    height: (bottom - top) / height,
  };
}

const meet = (a: Rect, b: Rect): boolean => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
