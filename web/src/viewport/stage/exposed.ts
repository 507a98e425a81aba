// What tests and measurements can ask the viewport: where a hull is seen, what is under a pixel, frames so far.
import { hullAt, pixelOfHull } from "./picking";
import type { Stage } from "./stage";

export interface Exposed {
  /** A pixel of the window where a hull is seen, null where nothing of it is. */
  project(name: string): { x: number; y: number } | null;
  hullAt(x: number, y: number): string | null;
  frames(): number;
}

declare global {
  interface Window {
    meshforgeViewport?: Exposed;
  }
}

/** Offers it on the window, and marks the root with the asset whose first frame was drawn, until called. */
export function expose(stage: Stage, root: HTMLElement): () => void {
  const corner = (): DOMRect => (root.querySelector("canvas") ?? root).getBoundingClientRect();
  const exposed: Exposed = {
    project: (name) => {
      const { left, top } = corner();
      const seen = pixelOfHull(stage, name, (x, y) => isOpen(root, left + x, top + y));
      return seen && { x: left + seen.x, y: top + seen.y };
    },
    hullAt: (x, y) => hullAt(stage, x - corner().left, y - corner().top),
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
