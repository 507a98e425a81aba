// How hulls and their thin edges are drawn: flat faces under soft light, with colours and states looked up in a small
// texture by the hull's place.
import {
  DataTexture,
  FrontSide,
  type IUniform,
  NearestFilter,
  RGBAFormat,
  DoubleSide,
  ShaderMaterial,
  SRGBColorSpace,
  UnsignedByteType,
} from "three";
import type { ThemeColors } from "./themeColors";

/** Hulls in a row of the textures. */
const WIDTH = 256;

/** What is to become of a hull, as the third byte of its state has it. */
export const ROLE = { plain: 0, washed: 1, removed: 2 } as const;

/** How a hull's colour is laid on, as the fourth byte of it has it. */
export const FILL_BYTES = { hatched: 0, dotted: 128, solid: 255 } as const;

/** What all materials of one set of hulls share; changing a value changes it for all. */
export interface SharedUniforms {
  readonly colors: IUniform;
  readonly states: IUniform;
  readonly explode: IUniform<number>;
  readonly ink: Readonly<Record<"pale" | "removed", IUniform>>;
  readonly pixel: IUniform<number>;
}

export function shareUniforms(colors: ByteTable, states: ByteTable, ink: ThemeColors): SharedUniforms {
  return {
    colors: { value: colors.texture },
    states: { value: states.texture },
    explode: { value: 0 },
    ink: { pale: { value: ink.pale }, removed: { value: ink.removed } },
    pixel: { value: 1 },
  };
}

/**
 * How much farther away each layer is drawn, of half the depth from near to far, at one pixel of the drawing for one of
 * the page. Vertices are moved to a grid in each pixel, so depths are wrong by a share of what a face rises in a pixel:
 * graphics cards have 256 steps, software has 16. (An offset by slope, as OpenGL has it, would differ by triangle.)
 */
export const LAYER_STEP = { card: 2e-5, software: 1.6e-4 } as const;
/** The step of all materials; `getCanvas` sets it. */
export const layerStep: IUniform<number> = { value: LAYER_STEP.card };

/** Puts a vertex where its hull is, or out of sight; also used by lines and by the picture of places. */
export const PLACE_VERTEX = /* glsl */ `
  in float owner;
  in vec3 away;
  in float layer;
  uniform float pixel;
  uniform float layerStep;
  uniform sampler2D colors;
  uniform sampler2D states;
  uniform float explode;
  ivec2 place() { int k = int(owner + 0.5); return ivec2(k % ${WIDTH}, k / ${WIDTH}); }
  vec4 placed(vec4 state) {
    if (state.r < 0.5) return vec4(0.0, 0.0, -2.0, 1.0);
    return modelViewMatrix * vec4(position + explode * away, 1.0);
  }
  vec4 projected(vec4 state) {
    if (state.r < 0.5) return placed(state);
    vec4 at = projectionMatrix * placed(state);
    at.z += layerStep / pixel * layer * at.w;
    return at;
  }
`;

/** Leave out what is beyond the section plane; `clipAt` is given a vertex as the camera sees it. */
export const SECTION_VERTEX = /* glsl */ `
  #include <clipping_planes_pars_vertex>
  void clipAt(vec4 seen) {
    #if NUM_CLIPPING_PLANES > 0
      vClipPosition = -seen.xyz;
    #endif
  }
`;

export const SECTION_FRAGMENT = /* glsl */ `
  #include <clipping_planes_pars_fragment>
  void clip() {
    #if NUM_CLIPPING_PLANES > 0
      if (dot(vClipPosition, clippingPlanes[0].xyz) > clippingPlanes[0].w) discard;
    #endif
  }
`;

/** Light on a face with a normal, as the camera sees it: from the sky, from the upper left, a little from the right. */
export const LIGHT = /* glsl */ `
  float light(vec3 n) {
    float sky = 0.5 + 0.5 * dot(n, viewMatrix[2].xyz);
    float key = max(dot(n, vec3(-0.450, 0.500, 0.740)), 0.0);
    float fill = max(dot(n, vec3(0.862, 0.000, 0.507)), 0.0);
    return 0.3 + 0.3 * sky + 0.5 * key + 0.12 * fill;
  }
`;

// all that is the same on a whole face is reckoned at its last corner, so that pixels cost next to nothing
const FACE_VERTEX = /* glsl */ `
  ${PLACE_VERTEX}
  ${SECTION_VERTEX}
  flat out vec4 color;
  flat out vec3 stripe;
  flat out float role;
  uniform vec3 pale;
  uniform vec3 removed;
  #include <colorspace_pars_fragment>
  ${LIGHT}
  void main() {
    vec4 base = texelFetch(colors, place(), 0);
    vec4 state = texelFetch(states, place(), 0);
    role = floor(state.b * 255.0 + 0.5);
    if (role == ${ROLE.removed}.0) base.rgb = mix(base.rgb, removed, 0.55);
    if (role == ${ROLE.washed}.0) base.rgb = mix(base.rgb, pale, 0.45);
    float lit = light(mat3(modelViewMatrix) * normal);
    vec3 glow = vec3(1.0); // paler, in no other hue: that is the label's, and outlines say what is selected
    float share = 0.16 * max(state.g, state.a);
    color = sRGBTransferOETF(vec4(mix(base.rgb, glow, share) * lit, base.a));
    stripe = color.rgb;
    if (base.a < 0.75) {
      vec3 paler = sRGBTransferOETF(vec4(mix(mix(base.rgb, vec3(1.0), base.a < 0.25 ? 0.62 : 0.4), glow, share) * lit, 1.0)).rgb;
      if (base.a < 0.25) stripe = paler;
      else { color.rgb = paler; stripe = 0.7 * paler; }
    }
    clipAt(placed(state));
    gl_Position = projected(state);
  }
`;

const FACE_FRAGMENT = /* glsl */ `
  precision highp float;
  flat in vec4 color;
  flat in vec3 stripe;
  flat in float role;
  uniform float pixel;
  uniform float opacity;
  ${SECTION_FRAGMENT}
  void main() {
    clip();
    gl_FragColor = vec4(color.rgb, opacity);
    #ifdef CUT_OPEN
      if (fract((gl_FragCoord.x - gl_FragCoord.y) / pixel / 6.0) < 0.2) gl_FragColor.rgb *= 0.8;
    #endif
    if (role < ${ROLE.removed}.0 && color.a > 0.75) return;
    vec2 spot = gl_FragCoord.xy / pixel;
    vec2 cell = mod(floor(spot / 2.0), 2.0);
    if (role == ${ROLE.removed}.0 && cell.x != cell.y) discard;
    if (color.a < 0.25 && fract((spot.x + spot.y) / 9.0) < 0.4) gl_FragColor.rgb = stripe;
    vec2 grid = fract(vec2(spot.x + spot.y, spot.x - spot.y) / 10.0) - 0.5;
    if (color.a > 0.25 && color.a < 0.75 && dot(grid, grid) < 0.022) gl_FragColor.rgb = stripe;
  }
`;

export function hullMaterial(common: SharedUniforms, opacity = 1): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: FACE_VERTEX,
    fragmentShader: FACE_FRAGMENT,
    uniforms: { ...placeUniforms(common), ...common.ink, opacity: { value: opacity } },
    transparent: opacity < 1,
    depthWrite: opacity === 1,
    side: FrontSide,
    clipping: true,
  });
}

/** For faces that close hulls which are cut open: hatched, and never cut themselves. */
export function sectionFaceMaterial(common: SharedUniforms): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: FACE_VERTEX,
    fragmentShader: FACE_FRAGMENT,
    uniforms: { ...placeUniforms(common), ...common.ink, opacity: { value: 1 } },
    defines: { CUT_OPEN: 1 },
    side: DoubleSide,
  });
}

export const placeUniforms = ({ colors, states, explode, pixel }: SharedUniforms) => ({
  colors,
  states,
  explode,
  pixel,
  layerStep,
});

const LINE_VERTEX = /* glsl */ `
  ${PLACE_VERTEX}
  ${SECTION_VERTEX}
  flat out vec3 color;
  flat out float shown;
  void main() {
    vec4 state = texelFetch(states, place(), 0);
    color = texelFetch(colors, place(), 0).rgb;
    vec4 at = placed(state);
    clipAt(at);
    shown = state.b > 0.006 ? 0.35 : 1.0;
    // a little towards the eye, so that the faces beside it do not cover it
    if (isOrthographic) at.z += 0.0008 * abs(at.z); else at.xyz *= 0.9992;
    gl_Position = state.r < 0.5 ? at : projectionMatrix * at;
  }
`;

const LINE_FRAGMENT = /* glsl */ `
  precision highp float;
  flat in vec3 color;
  flat in float shown;
  uniform float wire;
  ${SECTION_FRAGMENT}
  void main() {
    clip();
    gl_FragColor = vec4(color * mix(0.22, 0.85, wire), mix(0.5 * shown, 0.95, wire));
    #include <colorspace_fragment>
  }
`;

/** wire: 1 where there are no faces. */
export function lineMaterial(common: SharedUniforms, wire: IUniform<number>): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: LINE_VERTEX,
    fragmentShader: LINE_FRAGMENT,
    uniforms: { ...placeUniforms(common), wire },
    transparent: true,
    depthWrite: false,
    clipping: true,
  });
}

/** A small texture that holds four bytes for each hull, so that a change of looks never touches geometry. */
export class ByteTable {
  readonly texture: DataTexture;
  private readonly data: Uint8Array;

  /** colors: whether the first three bytes are a colour as the screen has it. */
  constructor(count: number, colors: boolean) {
    const rows = Math.max(1, Math.ceil(count / WIDTH));
    this.data = new Uint8Array(4 * WIDTH * rows);
    this.texture = new DataTexture(this.data, WIDTH, rows, RGBAFormat, UnsignedByteType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
    if (colors) this.texture.colorSpace = SRGBColorSpace;
    this.texture.needsUpdate = true;
  }

  set(k: number, r: number, g: number, b: number, a: number): void {
    this.data.set([r, g, b, a], 4 * k);
  }

  /** To be called once after a round of changes. */
  changed(): void {
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
  }
}
