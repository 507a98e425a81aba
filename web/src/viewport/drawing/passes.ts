// Drawing into a texture that later drawing reads.
import { Color, type ShaderMaterial, type WebGLRenderer, type WebGLRenderTarget } from "three";
import { FullScreenQuad } from "three/addons/postprocessing/Pass.js";

/** Draws into a target that is cleared before; the picture's own settings stay. */
export function drawInto(gl: WebGLRenderer, target: WebGLRenderTarget, draw: () => void): void {
  const [color, alpha] = [gl.getClearColor(new Color()), gl.getClearAlpha()];
  gl.setRenderTarget(target);
  gl.setClearColor(0, 0);
  gl.clear();
  draw();
  gl.setRenderTarget(null);
  gl.setClearColor(color, alpha);
}

const quad = new FullScreenQuad();

/** Runs a material over each pixel of a target. */
export function fill(gl: WebGLRenderer, target: WebGLRenderTarget, material: ShaderMaterial): void {
  quad.material = material;
  drawInto(gl, target, () => quad.render(gl));
}

/** For a material that covers all of what is drawn; `spot` goes from 0 to 1 over it. */
export const COVER_VERTEX = /* glsl */ `
  out vec2 spot;
  void main() {
    spot = 0.5 + 0.5 * position.xy;
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }
`;
