// Drawing into a texture that later drawing reads: of a scene, or of each pixel anew.
import { BufferAttribute, BufferGeometry, Camera, Color, Mesh, Scene, type ShaderMaterial, type WebGLRenderer, type WebGLRenderTarget } from "three";

/** Draws a scene into a target that is cleared before; the picture's own settings stay. */
export function drawInto(gl: WebGLRenderer, target: WebGLRenderTarget, scene: Scene, camera: Camera): void {
  const [color, alpha] = [gl.getClearColor(new Color()), gl.getClearAlpha()];
  gl.setRenderTarget(target);
  gl.setClearColor(0, 0);
  gl.clear();
  gl.render(scene, camera);
  gl.setRenderTarget(null);
  gl.setClearColor(color, alpha);
}

/** A triangle that covers all of a picture; `uv` goes from 0 to 1 over it. */
export function coveringTriangle(material: ShaderMaterial): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
  const out = new Mesh(geometry, material);
  out.frustumCulled = false;
  return out;
}

export const COVER_VERTEX = /* glsl */ `
  out vec2 spot;
  void main() {
    spot = 0.5 + 0.5 * position.xy;
    gl_Position = vec4(position.xy, 0.0, 1.0);
  }
`;

const nowhere = new Camera();
const passes = new WeakMap<ShaderMaterial, Scene>();

/** Runs a material that has COVER_VERTEX over each pixel of a target. */
export function runOver(gl: WebGLRenderer, target: WebGLRenderTarget, material: ShaderMaterial): void {
  let scene = passes.get(material);
  if (!scene) passes.set(material, (scene = new Scene().add(coveringTriangle(material))));
  drawInto(gl, target, scene, nowhere);
}
