// Draws the panes of the picture, each with the same camera, clipped to its part.
import type { WebGLRenderer } from "three";
import type { Side } from "../drawing/side";
import type { Pane } from "./panes";
import type { Stage } from "./stage";

export function drawPanes(gl: WebGLRenderer, stage: Stage, panes: readonly Pane[]): void {
  gl.autoClear = false;
  gl.setScissorTest(false);
  gl.setViewport(0, 0, stage.width, stage.height);
  gl.clear();
  gl.setScissorTest(panes.length > 1);
  for (const pane of panes) drawPane(gl, stage, pane);
}

function drawPane(gl: WebGLRenderer, stage: Stage, pane: Pane): void {
  const side = stage.sideOf(pane);
  const camera = stage.view.camera();
  const { settings, height, pixel } = stage;
  gl.setViewport(pane.x, 0, pane.width, height);
  gl.setScissor(pane.clip[0], 0, pane.clip[1] - pane.clip[0], height);
  const frame = { width: pane.width, height, pixel, explode: settings.explode, eye: stage.eye(camera) };
  if (settings.grid) gl.render(stage.contents.ground.scene, camera);
  if (!side) return;
  prepare(stage, side);
  side.measure(frame);
  stage.contents.graph.measure(frame);
  stage.contents.cut.measure(frame);
  stage.contents.made?.measure(frame);
  gl.render(side.root, camera);
}

/** Edges from which on a scene is too much for thin lines where drawing is slow. */
export const MANY_LINES = 6000;

function prepare({ settings, contents: { graph, ghost }, coarse }: Stage, side: Side): void {
  side.hulls.setWireframe(settings.wireframe, coarse && side.hulls.sharpEdges > MANY_LINES);
  side.opaque.object.visible = settings.opaque;
  graph.object.visible = settings.contacts;
  if (ghost) ghost.object.visible = settings.ghost;
}
