// How the thin edges of hulls are drawn: darker than their faces, or in their colour where faces are not drawn.
import { ShaderMaterial, type IUniform } from "three";
import { PLACING, placing, type Shared } from "./hullShader";

const VERTEX = /* glsl */ `
  ${PLACING}
  flat out vec3 color;
  flat out float shown;
  void main() {
    vec4 state = texelFetch(states, place(), 0);
    color = texelFetch(colors, place(), 0).rgb;
    vec4 at = placed(state);
    shown = state.b > 0.006 ? 0.35 : 1.0;
    // a little towards the eye, so that the faces beside it do not cover it
    if (isOrthographic) at.z += 0.0008 * abs(at.z); else at.xyz *= 0.9992;
    gl_Position = state.r < 0.5 ? at : projectionMatrix * at;
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  flat in vec3 color;
  flat in float shown;
  uniform float wire;
  void main() {
    gl_FragColor = vec4(color * mix(0.22, 0.85, wire), mix(0.5 * shown, 0.95, wire));
    #include <colorspace_fragment>
  }
`;

/** wire: 1 where there are no faces. */
export function lineMaterial(common: Shared, wire: IUniform<number>): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...placing(common), wire },
    transparent: true,
    depthWrite: false,
  });
}
