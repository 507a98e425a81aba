// A soft shadow on the ground below the asset: its hulls as seen from below, darker the lower they are, out of focus.
// Drawn anew only where the hulls in sight change, never as the camera moves.
import {
  BufferAttribute,
  BufferGeometry,
  FrontSide,
  Mesh,
  OrthographicCamera,
  Scene,
  ShaderMaterial,
  Vector2,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { HullSet } from "./hullSet";
import { PLACE_VERTEX, placeUniforms } from "./hullShader";
import { COVER_VERTEX, drawInto, runOver } from "./passes";

const PIXELS = 256;
/** Room for what is out of focus, of the size of the asset. */
const RIM = 0.3;
/** From one of the taps of the blur to the next, of the picture. */
const STEPS = [0.006, 0.014];
const DARKNESS = { light: 0.3, dark: 0.55 };

const BELOW_VERTEX = /* glsl */ `
  ${PLACE_VERTEX}
  void main() {
    gl_Position = projected(texelFetch(states, place(), 0));
  }
`;

const BELOW_FRAGMENT = /* glsl */ `
  precision highp float;
  void main() {
    float low = 1.0 - gl_FragCoord.z;
    gl_FragColor = vec4(vec3(low * low), 1.0);
  }
`;

const BLUR_FRAGMENT = /* glsl */ `
  precision highp float;
  in vec2 spot;
  uniform sampler2D from;
  uniform vec2 apart;
  void main() {
    float sum = 0.0;
    float all = 0.0;
    for (int k = -4; k <= 4; k++) {
      float weight = exp(-float(k * k) / 8.0);
      sum += weight * texture(from, spot + float(k) * apart).r;
      all += weight;
    }
    gl_FragColor = vec4(vec3(sum / all), 1.0);
  }
`;

const SHOW_VERTEX = /* glsl */ `
  in vec2 spot;
  out vec2 place;
  void main() {
    place = spot;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const SHOW_FRAGMENT = /* glsl */ `
  precision highp float;
  in vec2 place;
  uniform sampler2D shadow;
  uniform float darkness;
  void main() {
    gl_FragColor = vec4(0.03, 0.035, 0.05, darkness * texture(shadow, place).r);
  }
`;

const blur = new ShaderMaterial({
  vertexShader: COVER_VERTEX,
  fragmentShader: BLUR_FRAGMENT,
  uniforms: { from: { value: null }, apart: { value: new Vector2() } },
  depthTest: false,
  depthWrite: false,
});

export class GroundShadow {
  readonly object: Mesh<BufferGeometry, ShaderMaterial>;
  private readonly hulls = new Scene();
  private readonly mesh: Mesh;
  private targets: readonly [WebGLRenderTarget, WebGLRenderTarget] | null = null;
  private drawn = "";

  constructor(private readonly set: HullSet) {
    const uniforms = { shadow: { value: null }, darkness: { value: 0 } };
    const material = new ShaderMaterial({ vertexShader: SHOW_VERTEX, fragmentShader: SHOW_FRAGMENT, uniforms, transparent: true, depthWrite: false, side: FrontSide });
    this.object = new Mesh(new BufferGeometry(), material);
    this.object.renderOrder = -2;
    this.object.frustumCulled = false;
    this.object.visible = false;
    const below = new ShaderMaterial({ vertexShader: BELOW_VERTEX, fragmentShader: BELOW_FRAGMENT, uniforms: placeUniforms(set.common) });
    this.mesh = new Mesh(set.faceGeometry, below);
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
    this.hulls.add(this.mesh);
  }

  /** Shows it on the ground below a box; drawn anew where something changed and it may be now. */
  update(gl: WebGLRenderer, box: readonly number[], explode: number, dark: boolean, mayDraw: boolean): void {
    const key = [box, explode, this.set.visible.map(Number).join("")].join();
    if (key !== this.drawn && mayDraw) {
      this.drawn = key;
      this.draw(gl, box);
    }
    const { darkness } = this.object.material.uniforms;
    if (darkness) darkness.value = dark ? DARKNESS.dark : DARKNESS.light;
    this.object.visible = this.drawn !== "";
  }

  hide(): void {
    this.object.visible = false;
  }

  dispose(): void {
    this.object.geometry.dispose();
    for (const target of this.targets ?? []) target.dispose();
  }

  private draw(gl: WebGLRenderer, box: readonly number[]): void {
    const [x0, y0, z0, x1, y1, z1] = box as [number, number, number, number, number, number];
    const size = Math.max(x1 - x0, y1 - y0, z1 - z0, 1e-6);
    const [x, y, wide, deep] = [(x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2 + RIM * size, (y1 - y0) / 2 + RIM * size];
    // as seen from below, x goes to the left
    const camera = new OrthographicCamera(-wide, wide, deep, -deep, 0, Math.max(z1 - z0, 1e-6) * 1.05);
    camera.position.set(x, y, z0 - 1e-4 * size);
    camera.up.set(0, 1, 0);
    camera.lookAt(x, y, z0 + size);
    camera.updateMatrixWorld();
    const target = (): WebGLRenderTarget => new WebGLRenderTarget(PIXELS, PIXELS);
    const [first, second] = (this.targets ??= [target(), target()]);
    this.mesh.matrix.copy(this.set.object.matrixWorld);
    drawInto(gl, first, this.hulls, camera);
    const { from, apart } = blur.uniforms as { from: { value: unknown }; apart: { value: Vector2 } };
    for (const reach of STEPS) {
      const [across, along] = wide > deep ? [reach * (deep / wide), reach] : [reach, reach * (wide / deep)];
      from.value = first.texture;
      apart.value.set(across, 0);
      runOver(gl, second, blur);
      from.value = second.texture;
      apart.value.set(0, along);
      runOver(gl, first, blur);
    }
    this.place([x, y, z0 - 6e-4 * size], wide, deep);
    const { shadow } = this.object.material.uniforms;
    if (shadow) shadow.value = first.texture;
  }

  private place([x, y, z]: readonly [number, number, number], wide: number, deep: number): void {
    const corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]] as const;
    const { geometry } = this.object;
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.flatMap(([a, b]) => [x + a * wide, y + b * deep, z])), 3));
    geometry.setAttribute("spot", new BufferAttribute(new Float32Array(corners.flatMap(([a, b]) => [(1 - a) / 2, (1 + b) / 2])), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
  }
}
