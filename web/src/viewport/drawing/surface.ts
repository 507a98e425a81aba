// Surfaces that are no hulls: non-convex pieces, and the visual mesh as a ghost.
import { BufferAttribute, BufferGeometry, type Color, DoubleSide, Group, Mesh, ShaderMaterial } from "three";
import type { Shape } from "../../server/packet";
import { mergeShapes, type MergedShapes } from "../geometry/triangles";
import { LIGHT, SECTION_FRAGMENT, SECTION_VERTEX } from "./hullShader";

const VERTEX = /* glsl */ `
  out vec3 seen;
  ${SECTION_VERTEX}
  void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    clipAt(at);
    seen = at.xyz;
    gl_Position = projectionMatrix * at;
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  in vec3 seen;
  uniform vec3 color;
  uniform float opacity;
  ${LIGHT}
  ${SECTION_FRAGMENT}
  void main() {
    clip();
    gl_FragColor = vec4(color * light(normalize(cross(dFdx(seen), dFdy(seen)))), opacity);
    #include <colorspace_fragment>
  }
`;

/** Translucent surfaces in one colour; the one that is pointed at is denser. */
export class Surfaces {
  readonly object = new Group();
  readonly shapes: MergedShapes;

  constructor(
    readonly rows: readonly { name: string; shape: Shape }[],
    color: Color,
    private readonly opacity: number,
  ) {
    this.shapes = mergeShapes(rows.map((row) => row.shape));
    for (const { shape } of rows) {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(shape.positions, 3));
      geometry.setIndex(new BufferAttribute(shape.index, 1));
      const mesh = new Mesh(geometry, material(color, opacity));
      mesh.renderOrder = 3;
      this.object.add(mesh);
    }
  }

  point(name: string | null): void {
    this.rows.forEach((row, k) => this.set(k, "opacity", row.name === name ? 1.6 * this.opacity : this.opacity));
  }

  recolor(color: Color): void {
    this.rows.forEach((_, k) => this.set(k, "color", color));
  }

  dispose(): void {
    for (const mesh of this.object.children as Mesh[]) mesh.geometry.dispose();
  }

  private set(k: number, name: "color" | "opacity", value: unknown): void {
    const uniform = ((this.object.children[k] as Mesh).material as ShaderMaterial).uniforms[name];
    if (uniform) uniform.value = value;
  }
}

function material(color: Color, opacity: number): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { color: { value: color }, opacity: { value: opacity } },
    transparent: true,
    depthWrite: false,
    side: DoubleSide,
    clipping: true,
  });
}
