// A soft shadow on the ground below the asset: its hulls as seen from below, darker the lower they are, out of focus.
// Drawn anew only where the hulls in sight change, never as the camera moves.
import { Color, Mesh, MeshBasicMaterial, OrthographicCamera, PlaneGeometry, RepeatWrapping, Scene, ShaderMaterial, SRGBColorSpace, type WebGLRenderer, WebGLRenderTarget } from "three";
import { HorizontalBlurShader } from "three/addons/shaders/HorizontalBlurShader.js";
import { VerticalBlurShader } from "three/addons/shaders/VerticalBlurShader.js";
import type { HullSet } from "./hullSet";
import { PLACE_VERTEX } from "./hullShader";
import { drawInto, fill } from "./passes";

const PIXELS = 256;
/** Room for what is out of focus, of the size of the asset. */
const RIM = 0.3;
/** From one of the taps of the blur to the next, of the picture. */
const STEPS = [0.006, 0.014];
const DARKNESS = { light: 0.3, dark: 0.55 };
const COLOR = new Color().setRGB(0.03, 0.035, 0.05, SRGBColorSpace);

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

const across = new ShaderMaterial(HorizontalBlurShader);
const along = new ShaderMaterial(VerticalBlurShader);

/** Blurs what is in one target into another. */
function blur(gl: WebGLRenderer, from: WebGLRenderTarget, to: WebGLRenderTarget, material: ShaderMaterial, step: number): void {
  for (const [name, value] of [["tDiffuse", from.texture], ["h", step], ["v", step]] as const) {
    if (material.uniforms[name]) material.uniforms[name].value = value;
  }
  fill(gl, to, material);
}

export class GroundShadow {
  readonly object = new Mesh(new PlaneGeometry(2, 2), new MeshBasicMaterial({ color: COLOR, transparent: true, depthWrite: false }));
  private targets: readonly [WebGLRenderTarget, WebGLRenderTarget] | null = null;
  private drawn = "";

  constructor(private readonly set: HullSet) {
    this.object.renderOrder = -2;
    // the section plane leaves it whole
    this.object.material.onBeforeCompile = (shader) => (shader.fragmentShader = shader.fragmentShader.replace("#include <clipping_planes_fragment>", ""));
    this.object.visible = false;
  }

  /** Shows it on the ground below a box; drawn anew where something changed and it may be now. */
  update(gl: WebGLRenderer, box: readonly number[], explode: number, dark: boolean, mayDraw: boolean): void {
    const key = [box, explode, this.set.visible.map(Number).join("")].join();
    if (key !== this.drawn && mayDraw) {
      this.drawn = key;
      this.draw(gl, box);
    }
    this.object.material.opacity = dark ? DARKNESS.dark : DARKNESS.light;
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
    const camera = new OrthographicCamera(-wide, wide, deep, -deep, 0, Math.max(z1 - z0, 1e-6) * 1.05);
    camera.position.set(x, y, z0 - 1e-4 * size);
    camera.up.set(0, 1, 0);
    camera.lookAt(x, y, z0 + size);
    camera.updateMatrixWorld();
    const [first, second] = (this.targets ??= this.begin());
    const hulls = this.set.facesWith(BELOW_VERTEX, BELOW_FRAGMENT);
    drawInto(gl, first, () => gl.render(new Scene().add(hulls), camera));
    const long = Math.max(wide, deep);
    for (const reach of STEPS) {
      blur(gl, first, second, across, (reach * deep) / long);
      blur(gl, second, first, along, (reach * wide) / long);
    }
    this.object.position.set(x, y, z0 - 6e-4 * size);
    this.object.scale.set(wide, deep, 1);
    this.object.updateMatrixWorld();
  }

  private begin(): [WebGLRenderTarget, WebGLRenderTarget] {
    const targets: [WebGLRenderTarget, WebGLRenderTarget] = [new WebGLRenderTarget(PIXELS, PIXELS), new WebGLRenderTarget(PIXELS, PIXELS)];
    // as seen from below, x goes to the left
    const [{ texture }] = targets;
    texture.wrapS = RepeatWrapping;
    texture.repeat.x = -1;
    this.object.material.alphaMap = texture;
    this.object.material.needsUpdate = true;
    return targets;
  }
}
