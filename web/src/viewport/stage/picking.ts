// What is under a pixel of the viewport.
import { Matrix4, Vector3 } from "three";
import { type AssetDrawing, spotsOf } from "../drawing/assetDrawing";
import { planeIn } from "../drawing/section";
import { castRay, type Ray } from "../geometry/ray";
import { castThrough } from "../geometry/section";
import type { Point } from "../geometry/triangles";
import { hullsToPaint } from "../../store/alike";
import { useWorkspace } from "../../store/workspace";
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
  return side ? hullOf(stage, side, rayAt(stage, x, y)) : null;
}

/** The hull, or else the non-convex piece, under a pixel. */
export function pieceAt(stage: Stage, x: number, y: number): string | null {
  const side = stage.sideOf(stage.paneAt(x));
  if (!side) return null;
  const ray = rayAt(stage, x, y);
  return hullOf(stage, side, ray) ?? (stage.settings.opaque ? opaqueOf(side, ray) : null);
}

function hullOf({ section, settings }: Stage, { hulls, turned }: AssetDrawing, ray: Ray): string | null {
  const met = castThrough(hulls, ray, settings.explode, section && planeIn(section, turned.matrix));
  return met ? (hulls.names[met.place] ?? null) : null;
}

function opaqueOf({ opaque }: AssetDrawing, ray: Ray): string | null {
  const met = castRay(opaque.shapes, ray, opaque.rows.map(() => true), [], 0);
  return met ? (opaque.rows[met.place]?.name ?? null) : null;
}

type Pixel = { readonly x: number; readonly y: number };

/** A pixel of the viewport where a hull is seen and that is open to the pointer, null where there is none. */
function pixelOfHull(stage: Stage, name: string, isOpen: (x: number, y: number) => boolean): Pixel | null {
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

interface ViewportProbe {
  /** A pixel of the window where a hull is seen, null where nothing of it is. */
  project(name: string): { x: number; y: number } | null;
  hullAt(x: number, y: number): string | null;
  /** Hulls that are outlined as selected. */
  selected(): string[];
  /** Hulls that a click where the pointer is would paint. */
  toPaint(): readonly string[];
  frames(): number;
}

declare global {
  interface Window {
    meshforgeViewport?: ViewportProbe;
  }
}

/** Offers it on the window, and marks the root with the asset whose first frame was drawn, until called. */
export function exposeProbe(stage: Stage, root: HTMLElement): () => void {
  const corner = (): DOMRect => (root.querySelector("canvas") ?? root).getBoundingClientRect();
  const exposed: ViewportProbe = {
    project: (name) => {
      const { left, top } = corner();
      const seen = pixelOfHull(stage, name, (x, y) => isOpen(root, left + x, top + y));
      return seen && { x: left + seen.x, y: top + seen.y };
    },
    hullAt: (x, y) => hullAt(stage, x - corner().left, y - corner().top),
    selected: () => [...useWorkspace.getState().selection],
    toPaint: () => {
      const { hover, brush } = useWorkspace.getState();
      return hover === null || brush === null ? [] : hullsToPaint(hover, false);
    },
    frames: () => stage.frames,
  };
  window.meshforgeViewport = exposed;
  const stop = stage.onDrawn(() => {
    const asset = stage.shown?.scene.asset ?? "";
    if (root.dataset["ready"] !== asset) root.dataset["ready"] = asset;
  });
  return () => {
    stop();
    if (window.meshforgeViewport === exposed) delete window.meshforgeViewport;
  };
}

/** Whether nothing lies over the picture in a pixel of the window. */
const isOpen = (root: HTMLElement, x: number, y: number): boolean =>
  document.elementFromPoint(x, y) === root.querySelector("canvas");
