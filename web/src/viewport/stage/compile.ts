// Has the shaders of the picture made ready before there is anything to draw.
import { PerspectiveCamera, Scene, type WebGLRenderer } from "three";
import { Ground } from "../drawing/ground";
import { HullSet } from "../drawing/hullSet";
import { readInk } from "../drawing/ink";
import { Strokes } from "../drawing/strokes";

const BOX = [0, 0, 0, 1, 1, 1];

/** Begins to compile; whoever draws first waits for the rest. */
export function compile(gl: WebGLRenderer): void {
  const ink = readInk();
  const ground = new Ground();
  ground.fit(BOX, ink);
  const hulls = new HullSet([], [0, 0, 0], ink);
  const strokes = new Strokes(ink.selected, { width: 1, behind: 0.5 });
  const scene = new Scene();
  scene.add(hulls.object, strokes.object);
  const camera = new PerspectiveCamera();
  gl.compile(ground.scene, camera);
  gl.compile(scene, camera);
}
