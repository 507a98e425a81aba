// A picture of which hull is seen in each pixel, drawn when a region is begun.
import { type BufferGeometry, type Camera, DoubleSide, type Mesh, Scene, type ShaderMaterial, type WebGLRenderer, WebGLRenderTarget } from "three";
import type { HullSet } from "./hullSet";
import { PLACE_VERTEX, SECTION_FRAGMENT, SECTION_VERTEX } from "./hullShader";
import { drawInto } from "./passes";

const VERTEX = /* glsl */ `
  ${PLACE_VERTEX}
  ${SECTION_VERTEX}
  flat out int number;
  void main() {
    vec4 state = texelFetch(states, place(), 0);
    clipAt(placed(state));
    number = int(owner + 0.5) + 1;
    gl_Position = projected(state);
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  flat in int number;
  ${SECTION_FRAGMENT}
  void main() {
    clip();
    gl_FragColor = vec4(float(number & 255), float((number >> 8) & 255), float(number >> 16), 255.0) / 255.0;
  }
`;

/** For each pixel the place of the hull plus one, nought where there is none; rows from the top. closed: faces that close
 * the hulls where the section plane cuts them. */
export function drawHullIds(
  gl: WebGLRenderer,
  hulls: HullSet,
  closed: BufferGeometry | null,
  camera: Camera,
  width: number,
  height: number,
): Uint32Array {
  const scene = new Scene().add(hulls.facesWith(VERTEX, FRAGMENT, hulls.faceGeometry, { clipping: true }));
  if (closed) scene.add(hulls.facesWith(VERTEX, FRAGMENT, closed, { side: DoubleSide }));
  const target = new WebGLRenderTarget(width, height);
  drawInto(gl, target, () => gl.render(scene, camera));
  const bytes = new Uint8Array(4 * width * height);
  gl.readRenderTargetPixels(target, 0, 0, width, height, bytes);
  target.dispose();
  for (const mesh of scene.children as Mesh<BufferGeometry, ShaderMaterial>[]) mesh.material.dispose();
  return flipRows(bytes, width, height);
}

function flipRows(bytes: Uint8Array, width: number, height: number): Uint32Array {
  const out = new Uint32Array(width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const at = 4 * ((height - 1 - y) * width + x);
      out[y * width + x] = (bytes[at] ?? 0) | ((bytes[at + 1] ?? 0) << 8) | ((bytes[at + 2] ?? 0) << 16);
    }
  }
  return out;
}
