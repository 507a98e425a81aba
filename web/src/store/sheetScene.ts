// Several assets in one scene, beside each other on the ground, so that their hulls are selected and labelled as if of
// one.
import type { Shape } from "../server/packet";
import { sheetName } from "./hullPlaces";
import type { Scene, ScenePart } from "./scene";
import { ORIGIN, plus, type Vec } from "./vectors";

interface Box {
  readonly low: Vec;
  readonly high: Vec;
}

/** Room between assets, in widths; rows are so far apart that the one in front hides nothing of the next, nor its name. */
const GAP = 0.25;
const ROW_GAP = 2.6; // heights; 1 / tan(elevation) where one looks from at first, and room for a name
/** How much of the ground is seen from there, across the picture. */
const STEEP = 0.41;
/** Wished width of all, in heights of all as they are seen. */
const WIDE = 1.5;
/** Where one looks from as a sheet is opened, about the upright axis: rows go across it [rad]. */
export const SHEET_AZIMUTH = -0.95;
/** Assets can be drawn in one size where the largest is so many times the smallest. */
const UNEQUAL = 3;

/** Puts scenes of single assets beside each other, in their order; open: the asset whose hulls come first in the list,
 * so that their positions hold; oneSize: whether assets of very different sizes are drawn in that of the first. */
export function sheetOf(scenes: readonly Scene[], open: string, oneSize = false): Scene | null {
  const first = scenes.find(({ asset }) => asset === open) ?? scenes[0];
  if (!first) return null;
  const boxes = scenes.map(standingBox);
  const sizes = boxes.map(({ low, high }) => Math.hypot(...low.map((value, axis) => (high[axis] ?? 0) - value)) || 1);
  const isUneven = Math.max(...sizes) > UNEQUAL * Math.min(...sizes);
  const scales = sizes.map((size) => (oneSize && isUneven ? (sizes[0] ?? 1) / size : 1));
  const at = placesFor(boxes.map((box, k) => scaleBox(box, scales[k] ?? 1)));
  const placed = new Map(scenes.map((scene, k) => [scene.asset, place(scene, boxes[k] as Box, scales[k] ?? 1, at[k] as Vec)]));
  const order = [first, ...scenes.filter((scene) => scene !== first)].flatMap(({ asset }) => placed.get(asset) ?? []);
  const hulls = order.flatMap((one) => one.hulls);
  const contacts = order.flatMap((one) => one.contacts);
  const view = { ...first.view, hulls, contacts, opaque: [], near_misses: [], upright: null, unturned: null, has_visual: false };
  const parts = scenes.flatMap(({ asset }) => placed.get(asset)?.part ?? []);
  return { ...first, view: view as unknown as Scene["view"], hulls, contacts, opaque: [], edit: null, parts, isUneven };
}

/** Where each box goes: rows from the back to the front, each from the left to the right as one looks at them. */
function placesFor(boxes: readonly Box[]): Vec[] {
  const size = (axis: 0 | 1 | 2) => Math.max(...boxes.map(({ low, high }) => high[axis] - low[axis]), 1e-9);
  const [sine, cosine] = [Math.sin(SHEET_AZIMUTH), Math.cos(SHEET_AZIMUTH)];
  const seen = (along: number, across: number) => Math.abs(along) * size(0) + Math.abs(across) * size(1);
  // to the right, and away from the eye
  const [wide, deep] = [seen(sine, cosine) * (1 + GAP), seen(cosine, sine) + size(2) * ROW_GAP];
  const columns = Math.min(boxes.length, Math.max(1, Math.ceil(Math.sqrt((boxes.length * WIDE * deep * STEEP) / wide))));
  return boxes.map((_, k) => {
    const [right, near] = [(k % columns) * wide, Math.floor(k / columns) * deep];
    return [-sine * right + cosine * near, cosine * right + sine * near, 0];
  });
}

const scaleBox = ({ low, high }: Box, by: number): Box => ({ low: plus(ORIGIN, low, by), high: plus(ORIGIN, high, by) });

/** The box around an asset that stands upright. */
function standingBox(scene: Scene): Box {
  const low: [number, number, number] = [Infinity, Infinity, Infinity];
  const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
  for (const { shape } of scene.hulls) {
    const positions = transform(shape.positions, scene.view.upright, 1, [0, 0, 0]);
    for (let k = 0; k < positions.length; k++) {
      const [axis, value] = [(k % 3) as 0 | 1 | 2, positions[k] ?? 0];
      low[axis] = Math.min(low[axis], value);
      high[axis] = Math.max(high[axis], value);
    }
  }
  return scene.hulls.length ? { low, high } : { low: [0, 0, 0], high: [0, 0, 0] };
}

/** An asset where it stands: the middle of its box there, its foot on the ground. */
function place(scene: Scene, { low, high }: Box, scale: number, at: Vec) {
  const { asset, view } = scene;
  const mid = (axis: 0 | 1) => (low[axis] + high[axis]) / 2;
  const by: Vec = [at[0] - scale * mid(0), at[1] - scale * mid(1), at[2] - scale * low[2]];
  const there = (corner: Vec) => plus(by, corner, scale);
  return {
    hulls: scene.hulls.map((hull) => ({ ...hull, name: sheetName(asset, hull.name), shape: moved(hull.shape, view.upright, scale, by) })),
    contacts: scene.contacts.map(([a, b]) => [sheetName(asset, a), sheetName(asset, b)] as const),
    part: { asset, low: there(low), high: there(high), scale } satisfies ScenePart,
  };
}

const known = new WeakMap<Shape, { key: string; shape: Shape }>();

/** A shape that is turned, scaled and moved; the same object for the same move, so that it is not drawn anew. */
function moved(shape: Shape, turn: readonly number[] | null, scale: number, by: Vec): Shape {
  const key = [turn, scale, by].join();
  const before = known.get(shape);
  if (before?.key === key) return before.shape;
  const fresh = { positions: transform(shape.positions, turn, scale, by), index: shape.index };
  known.set(shape, { key, shape: fresh });
  return fresh;
}

/** turn: 16 numbers, row by row, null for none. */
function transform(positions: Float32Array, turn: readonly number[] | null, scale: number, by: Vec): Float32Array {
  const out = new Float32Array(positions.length);
  for (let k = 0; k < positions.length; k += 3) {
    const [x, y, z] = [positions[k] ?? 0, positions[k + 1] ?? 0, positions[k + 2] ?? 0];
    for (let axis = 0; axis < 3; axis++) {
      const row = (column: number): number => turn?.[4 * axis + column] ?? (column === axis ? 1 : 0);
      out[k + axis] = scale * (row(0) * x + row(1) * y + row(2) * z + row(3)) + (by[axis] ?? 0);
    }
  }
  return out;
}
