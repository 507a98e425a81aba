// A stage with boxes on it, and a renderer that only notes what it is asked to draw.
import { vi } from "vitest";
import type { Shape } from "../../server/packet";
import type { Scene } from "../../store/scenes";
import { initialWorkspace } from "../../store/workspace";
import { settingsOf } from "./panes";
import { Stage } from "./stage";

const CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, (k >> 1) & 1, (k >> 2) & 1] as const);
const FACES = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];

export interface Box {
  readonly name: string;
  readonly shape: Shape;
}

/** A box given by its lowest corner and its sizes [m]. */
export function box(name: string, low: readonly number[], size: readonly number[] = [1, 1, 1]): Box {
  const positions = CORNERS.flatMap((corner) => corner.map((c, axis) => (low[axis] ?? 0) + c * (size[axis] ?? 0)));
  return { name, shape: { positions: new Float32Array(positions), index: new Uint32Array(FACES) } };
}

/** A scene of boxes, in the order of their names given. */
export function boxScene(boxes: readonly Box[], change: Partial<Scene> = {}): Scene {
  const hulls = boxes.map((one) => ({ ...one, label: null, confidence: null, body: "", parent: null, made: false }));
  const view = { asset: "a", hulls, opaque: [], contacts: [], near_misses: [], bodies: [""], upright: null, has_visual: false, steps: [] };
  const scene = { asset: "a", showing: { kind: "source" }, view, hulls, opaque: [], contacts: [], edit: null };
  return { ...scene, ...change } as unknown as Scene;
}

/** What of the browser a stage asks for. */
export function stubBrowser(): void {
  vi.stubGlobal("matchMedia", () => ({ matches: false }));
  vi.stubGlobal("document", { documentElement: { dataset: {} } });
  vi.stubGlobal("getComputedStyle", () => ({ getPropertyValue: () => "#808080" }));
}

/** A stage of 400 by 300 pixels that looks at a scene from its usual side. */
export function stageOf(scene: Scene | null): Stage {
  const stage = new Stage(settingsOf(initialWorkspace.view), true);
  stage.resize(400, 300, 1);
  if (scene) stage.show(scene);
  stage.draw(renderer(), 0);
  return stage;
}

/** A renderer; drawn: the viewports of what it drew on the canvas, in order. */
export function renderer(drawn: unknown[] = []): never {
  let viewport: number[] = [];
  let target: unknown = null;
  return {
    getSize: (size: { set(x: number, y: number): unknown }) => size.set(0, 0),
    getPixelRatio: () => 1,
    setDrawingBufferSize: () => undefined,
    setScissorTest: () => undefined,
    setScissor: () => undefined,
    setViewport: (...place: number[]) => (viewport = place),
    clear: () => undefined,
    // what is drawn to be read is empty: no hull is seen in any pixel
    getClearColor: (color: unknown) => color,
    getClearAlpha: () => 1,
    setClearColor: () => undefined,
    setRenderTarget: (next: unknown) => (target = next),
    readRenderTargetPixels: () => undefined,
    render: (scene: object) => target ?? drawn.push({ scene, viewport }),
  } as never;
}
