// The canvas that the picture is drawn on, and its renderer: made once for the page, as that takes long.
import { WebGLRenderer } from "three";
import { compile } from "./stage/compile";

export interface Paper {
  readonly gl: WebGLRenderer;
  /** Whether the canvas smooths edges, which costs too much where the processor does what a graphics card should. */
  readonly smooth: boolean;
}

let made: Paper | null | undefined;

/** Null where this browser cannot draw in three dimensions. */
export function paper(): Paper | null {
  if (made === undefined) made = madeNow();
  return made;
}

function madeNow(): Paper | null {
  const quick = opened(true);
  const context = quick ?? opened(false);
  if (!context) return null;
  const gl = new WebGLRenderer({ canvas: context.canvas as HTMLCanvasElement, context });
  // asking for them means to wait for each shader; what is wrong with one shows all the same
  gl.debug.checkShaderErrors = false;
  compile(gl);
  return { gl, smooth: quick !== null };
}

/** A new canvas with a context; card: only if a graphics card draws on it. */
function opened(card: boolean): WebGL2RenderingContext | null {
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
