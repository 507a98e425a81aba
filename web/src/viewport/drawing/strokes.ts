// Lines of a width in pixels, dashed and with a casing where wanted: silhouettes of hulls as outlines, or lines between
// points.
import {
  type Color,
  DoubleSide,
  DynamicDrawUsage,
  Float32BufferAttribute,
  GreaterDepth,
  Group,
  InstancedBufferGeometry,
  InstancedInterleavedBuffer,
  InterleavedBufferAttribute,
  type IUniform,
  LessEqualDepth,
  Mesh,
  ShaderMaterial,
  Vector2,
} from "three";
import { SECTION_FRAGMENT, SECTION_VERTEX } from "./hullShader";
import { type Eye, LINE, type Outline, roomFor, writeSilhouettes } from "../geometry/edges";

export interface StrokeStyle {
  /** [px] */
  readonly width: number;
  /** Length of a dash [px], 0 for none. */
  readonly dash?: number;
  readonly opacity?: number;
  /** How strongly it shows through what is before it. */
  readonly behind?: number;
  /** Nothing covers it. */
  readonly over?: boolean;
  /** Width of the casing, a line below it in another colour [px]. */
  readonly casing?: number;
  /** Whether the section plane cuts it. */
  readonly cut?: boolean;
}

/** Of the width of a line, what is left where it shows through what is before it. */
const THINNER = 0.5;

/** What strokes need to know of the picture: its size and pixels, where the eye is, how far hulls are apart. */
export interface Frame {
  readonly width: number;
  readonly height: number;
  readonly pixel: number;
  readonly explode: number;
  readonly eye: Eye;
}

export class Strokes {
  readonly object = new Group();
  private readonly core: StrokeUniforms;
  private readonly casing: StrokeUniforms | null;
  private geometry = new InstancedBufferGeometry();
  private buffer = new InstancedInterleavedBuffer(new Float32Array(0), LINE);
  private outlines: readonly Outline[] = [];
  private written = "";

  /** casing: its colour, if the style has one. */
  constructor(
    color: Color,
    private readonly style: StrokeStyle,
    order = 2,
    casing?: Color,
  ) {
    this.core = strokeUniforms(color);
    this.casing = casing && style.casing ? strokeUniforms(casing) : null;
    // all casings first, so that they cover no line
    if (this.casing) this.add(this.casing, order);
    this.add(this.core, order + 0.5);
    this.object.visible = false;
  }

  set(outlines: readonly Outline[]): void {
    this.object.visible = outlines.length > 0;
    this.outlines = outlines;
    this.written = "";
  }

  recolor(color: Color, casing?: Color): void {
    this.core.color.value = color;
    if (this.casing && casing) this.casing.color.value = casing;
  }

  /** To be called before drawing. */
  measure({ width, height, pixel, explode, eye }: Frame): void {
    for (const uniforms of [this.core, this.casing]) {
      if (!uniforms) continue;
      uniforms.size.value.set(width * pixel, height * pixel);
      uniforms.width.value = pixel * (uniforms === this.core ? this.style.width : (this.style.casing ?? 0));
      uniforms.dash.value = pixel * (this.style.dash ?? 0);
    }
    const key = `${eye.at} ${eye.parallel} ${explode}`;
    if (!this.outlines.length || key === this.written) return;
    this.written = key;
    const room = roomFor(this.outlines);
    if (room > this.buffer.array.length) this.grow(2 * room);
    const count = writeSilhouettes(this.outlines, explode, eye, this.buffer.array as Float32Array);
    this.buffer.clearUpdateRanges();
    this.buffer.addUpdateRange(0, LINE * count);
    this.buffer.needsUpdate = true;
    this.geometry.instanceCount = count;
  }

  dispose(): void {
    this.geometry.dispose();
  }

  private add(uniforms: StrokeUniforms, order: number): void {
    for (const material of materialsOf(this.style, uniforms)) {
      const mesh = new Mesh(this.geometry, material);
      mesh.frustumCulled = false;
      mesh.renderOrder = order;
      this.object.add(mesh);
    }
  }

  private grow(numbers: number): void {
    this.geometry.dispose();
    this.geometry = new InstancedBufferGeometry();
    this.buffer = new InstancedInterleavedBuffer(new Float32Array(numbers), LINE);
    this.buffer.setUsage(DynamicDrawUsage);
    this.geometry.setAttribute("start", new InterleavedBufferAttribute(this.buffer, 3, 0));
    this.geometry.setAttribute("end", new InterleavedBufferAttribute(this.buffer, 3, 3));
    // at which end a corner is, and on which side of the line
    this.geometry.setAttribute("corner", new Float32BufferAttribute([-1, -1, -1, 1, 1, 1, 1, -1], 2));
    this.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    for (const mesh of this.object.children) (mesh as Mesh).geometry = this.geometry;
  }
}

function materialsOf({ opacity = 1, behind = 0, over, cut = false }: StrokeStyle, uniforms: StrokeUniforms): ShaderMaterial[] {
  if (over) return [strokeMaterial(uniforms, opacity, "over", cut)];
  const before = strokeMaterial(uniforms, opacity, "before", cut);
  return behind > 0 ? [before, strokeMaterial(uniforms, behind, "behind", cut)] : [before];
}

/** Lines between points as outlines. */
export function linesBetween(pairs: readonly (readonly [ArrayLike<number>, ArrayLike<number>])[]): Outline[] {
  const records = new Float32Array(12 * pairs.length);
  pairs.forEach(([a, b], k) => {
    records.set(a, 12 * k);
    records.set(b, 12 * k + 3);
  });
  return pairs.length ? [{ records, away: [0, 0, 0] }] : [];
}

interface StrokeUniforms {
  readonly color: IUniform<Color>;
  /** Both in pixels of the drawing. */
  readonly width: IUniform<number>;
  readonly dash: IUniform<number>;
  readonly size: IUniform<Vector2>;
}

/** How strokes are drawn: a quad of some pixels along each edge, dashed where wanted. */
const strokeUniforms = (color: Color): StrokeUniforms => ({
  color: { value: color },
  width: { value: 1 },
  dash: { value: 0 },
  size: { value: new Vector2(1, 1) },
});

const VERTEX = /* glsl */ `
  in vec3 start;
  in vec3 end;
  in vec2 corner;
  uniform vec2 size;
  uniform float width;
  uniform float share;
  flat out float upright;
  ${SECTION_VERTEX}
  // a little towards the eye, so that the faces beside it do not cover it
  vec4 nearer(vec3 p) {
    vec4 at = modelViewMatrix * vec4(p, 1.0);
    if (isOrthographic) at.z += 0.002 * abs(at.z); else at.xyz *= 0.998;
    return projectionMatrix * at;
  }
  void main() {
    vec3 at = corner.x < 0.0 ? start : end;
    clipAt(modelViewMatrix * vec4(at, 1.0));
    vec4 here = nearer(at);
    vec4 there = nearer(corner.x < 0.0 ? end : start);
    gl_Position = vec4(0.0, 0.0, -2.0, 1.0);
    upright = 0.0;
    if (here.w <= 0.0 || there.w <= 0.0) return;
    vec2 back = (here.xy / here.w - there.xy / there.w) * size;
    upright = abs(back.y) > abs(back.x) ? 1.0 : 0.0;
    back /= max(length(back), 1e-4);
    vec2 shift = 0.5 * share * width * (back + corner.x * corner.y * vec2(-back.y, back.x));
    gl_Position = here + vec4(2.0 * shift / size * here.w, 0.0, 0.0);
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  flat in float upright;
  uniform vec3 color;
  uniform float opacity;
  uniform float dash;
  ${SECTION_FRAGMENT}
  void main() {
    #ifdef CUT
      clip();
    #endif
    float spot = upright > 0.5 ? gl_FragCoord.y : gl_FragCoord.x;
    if (dash > 0.0 && fract(spot / (1.65 * dash)) > 0.6) discard;
    gl_FragColor = vec4(color, opacity);
    #include <colorspace_fragment>
  }
`;

/** where: before what is there, behind it only, or over all. */
function strokeMaterial(
  uniforms: StrokeUniforms,
  opacity: number,
  where: "before" | "behind" | "over",
  clipping: boolean,
): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...uniforms, opacity: { value: opacity }, share: { value: where === "behind" ? THINNER : 1 } },
    transparent: true,
    depthWrite: false,
    clipping,
    // a program of its own: three.js leaves the plane that it set for others in one that is shared
    ...(clipping ? { defines: { CUT: 1 } } : {}),
    depthTest: where !== "over",
    depthFunc: where === "behind" ? GreaterDepth : LessEqualDepth,
    side: DoubleSide,
  });
}
