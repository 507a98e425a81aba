// What this browser can draw with.
export interface Drawing {
  readonly works: boolean;
  /** Whether the processor does what a graphics card should. */
  readonly inSoftware: boolean;
}

/** Tries it on a canvas that is thrown away. */
export function tryDrawing(): Drawing {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return { works: false, inSoftware: false };
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return { works: true, inSoftware: /swiftshader|llvmpipe|software|basic render/i.test(name) };
}
