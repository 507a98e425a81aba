// The canvas that the picture is drawn on, and its renderer: made once for the page, with its shaders ready, as that
// takes long.
import { PerspectiveCamera, Scene, WebGLRenderer } from "three";
import { Ground } from "./drawing/ground";
import { HullSet } from "./drawing/hullSet";
import { LAYER_STEP, layerStep } from "./drawing/hullShader";
import { readThemeColors } from "./drawing/themeColors";
import { Strokes } from "./drawing/strokes";

export interface Canvas {
  readonly gl: WebGLRenderer;
  /** Whether the canvas smooths edges, which costs too much where the processor does what a graphics card should. */
  readonly smooth: boolean;
}

let canvas: Canvas | null | undefined;

/** Null where this browser cannot draw in three dimensions. */
export function getCanvas(): Canvas | null {
  if (canvas === undefined) canvas = createCanvas();
  return canvas;
}

function createCanvas(): Canvas | null {
  const quick = createContext(true);
  const context = quick ?? createContext(false);
  if (!context) return null;
  const gl = new WebGLRenderer({ canvas: context.canvas as HTMLCanvasElement, context });
  // asking for them means to wait for each shader; what is wrong with one shows all the same
  gl.debug.checkShaderErrors = false;
  layerStep.value = quick ? LAYER_STEP.card : LAYER_STEP.software;
  compileShaders(gl);
  return { gl, smooth: quick !== null };
}

/** A new canvas with a context; card: only if a graphics card draws on it. */
function createContext(card: boolean): WebGL2RenderingContext | null {
  const gl = document.createElement("canvas").getContext("webgl2", {
    alpha: true,
    stencil: false,
    antialias: card,
    failIfMajorPerformanceCaveat: card,
    powerPreference: "high-performance",
  });
  if (!gl || !card || !isSoftware(gl)) return gl;
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return null;
}

function isSoftware(gl: WebGL2RenderingContext): boolean {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

const BOX = [0, 0, 0, 1, 1, 1];

/** Begins to compile; whoever draws first waits for the rest. */
function compileShaders(gl: WebGLRenderer): void {
  const ink = readThemeColors();
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
