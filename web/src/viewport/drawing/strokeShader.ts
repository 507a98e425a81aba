// How strokes are drawn: a quad of some pixels along each edge, dashed where wanted.
import { type Color, DoubleSide, GreaterDepth, type IUniform, LessEqualDepth, ShaderMaterial, Vector2 } from "three";

export interface StrokeUniforms {
  readonly color: IUniform<Color>;
  /** Both in pixels of the drawing. */
  readonly width: IUniform<number>;
  readonly dash: IUniform<number>;
  readonly size: IUniform<Vector2>;
}

export const strokeUniforms = (color: Color): StrokeUniforms => ({
  color: { value: color },
  width: { value: 1 },
  dash: { value: 0 },
  size: { value: new Vector2(1, 1) },
});

const VERTEX = /* glsl */ `
  in vec3 other;
  in float side;
  uniform vec2 size;
  uniform float width;
  flat out float upright;
  // a little towards the eye, so that the faces beside it do not cover it
  vec4 nearer(vec3 p) {
    vec4 at = modelViewMatrix * vec4(p, 1.0);
    if (isOrthographic) at.z += 0.002 * abs(at.z); else at.xyz *= 0.998;
    return projectionMatrix * at;
  }
  void main() {
    vec4 here = nearer(position);
    vec4 there = nearer(other);
    gl_Position = vec4(0.0, 0.0, -2.0, 1.0);
    upright = 0.0;
    if (here.w <= 0.0 || there.w <= 0.0) return;
    vec2 back = (here.xy / here.w - there.xy / there.w) * size;
    upright = abs(back.y) > abs(back.x) ? 1.0 : 0.0;
    back /= max(length(back), 1e-4);
    vec2 shift = 0.5 * width * (back + side * vec2(-back.y, back.x));
    gl_Position = here + vec4(2.0 * shift / size * here.w, 0.0, 0.0);
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  flat in float upright;
  uniform vec3 color;
  uniform float opacity;
  uniform float dash;
  void main() {
    float spot = upright > 0.5 ? gl_FragCoord.y : gl_FragCoord.x;
    if (dash > 0.0 && fract(spot / (1.65 * dash)) > 0.6) discard;
    gl_FragColor = vec4(color, opacity);
    #include <colorspace_fragment>
  }
`;

/** where: before what is there, behind it only, or over all. */
export function strokeMaterial(
  uniforms: StrokeUniforms,
  opacity: number,
  where: "before" | "behind" | "over",
): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...uniforms, opacity: { value: opacity } },
    transparent: true,
    depthWrite: false,
    depthTest: where !== "over",
    depthFunc: where === "behind" ? GreaterDepth : LessEqualDepth,
    side: DoubleSide,
  });
}
