// What is under a pixel of the viewport.
import { Matrix4, Vector3 } from "three";
import type { Side } from "../drawing/side";
import { firstMet, type Ray } from "../picking/ray";
import type { Point } from "../shapes/merged";
import type { Stage } from "./stage";

/** The line of sight through a pixel, in the frame of the file. */
export function rayAt(stage: Stage, x: number, y: number): Ray {
  const pane = stage.paneAt(x);
  const { from, along } = stage.view.sightAt(x - pane.x, y);
  const back = stage.shown ? stage.shown.turned.matrix.clone().invert() : new Matrix4();
  return {
    from: new Vector3(...from).applyMatrix4(back).toArray(),
    along: new Vector3(...along).transformDirection(back).toArray(),
  };
}

/** The hull under a pixel, null for none. */
export function hullAt(stage: Stage, x: number, y: number): string | null {
  const side = stage.sideOf(stage.paneAt(x));
  return side ? hullOf(side, rayAt(stage, x, y), stage.settings.explode) : null;
}

/** The hull, or else the opaque piece, under a pixel. */
export function pieceAt(stage: Stage, x: number, y: number): string | null {
  const side = stage.sideOf(stage.paneAt(x));
  if (!side) return null;
  const ray = rayAt(stage, x, y);
  return hullOf(side, ray, stage.settings.explode) ?? (stage.settings.opaque ? opaqueOf(side, ray) : null);
}

function hullOf({ hulls }: Side, ray: Ray, explode: number): string | null {
  const met = firstMet(hulls.shapes, ray, hulls.visible, hulls.aways, explode);
  return met ? (hulls.names[met.place] ?? null) : null;
}

function opaqueOf({ opaque }: Side, ray: Ray): string | null {
  const met = firstMet(opaque.shapes, ray, opaque.rows.map(() => true), [], 0);
  return met ? (opaque.rows[met.place]?.name ?? null) : null;
}

type Pixel = { readonly x: number; readonly y: number };

/** A pixel of the viewport where a hull is seen and that is open to the pointer, null where there is none. */
export function pixelOfHull(stage: Stage, name: string, isOpen: (x: number, y: number) => boolean): Pixel | null {
  const side = stage.shown;
  const place = side?.hulls.places.get(name);
  const pane = stage.panes().at(-1);
  if (!side || !pane || place === undefined) return null;
  const seen = (spot: Point): Pixel | null => {
    const { x, y } = stage.pixelOf(spot, pane);
    const inside = x > pane.clip[0] && x < pane.clip[1] && y > 0 && y < stage.height;
    return inside && hullAt(stage, x, y) === name && isOpen(x, y) ? { x, y } : null;
  };
  for (const spot of spotsOf(side, place, stage.settings.explode)) {
    const pixel = seen(spot);
    if (pixel) return pixel;
  }
  return null;
}

/** The middle of a hull, and of each of its triangles. */
export function* spotsOf({ hulls }: Side, place: number, explode: number): Generator<Point> {
  yield hulls.middle(place, explode);
  const { faces, index, positions } = hulls.shapes;
  const away = hulls.aways[place] ?? [0, 0, 0];
  for (let face = faces[place] ?? 0; face < (faces[place + 1] ?? 0); face++) {
    const mid = (axis: number): number =>
      [0, 1, 2].reduce((sum, k) => sum + (positions[3 * (index[3 * face + k] ?? 0) + axis] ?? 0) / 3, 0) +
      explode * (away[axis] ?? 0);
    yield [mid(0), mid(1), mid(2)];
  }
}
