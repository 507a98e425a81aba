// The contact graph over the hulls: a dot for each hull, a line for each contact, dashes for those that nearly touch.
import { BufferAttribute, BufferGeometry, Group, Points, ShaderMaterial } from "three";
import type { Point } from "../geometry/triangles";
import { type Frame, linesBetween, Strokes } from "./strokes";
import type { ThemeColors } from "./themeColors";

const VERTEX = /* glsl */ `
  uniform float size;
  in float strong;
  out float lit;
  void main() {
    lit = strong;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_PointSize = size * (1.0 + 0.45 * strong);
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  in float lit;
  uniform vec3 plain;
  uniform vec3 strong;
  uniform vec3 rim;
  void main() {
    float r = 2.0 * length(gl_PointCoord - 0.5);
    if (r > 1.0) discard;
    gl_FragColor = vec4(r > 0.7 ? rim : mix(plain, strong, lit), 1.0);
    #include <colorspace_fragment>
  }
`;

export interface GraphLine {
  readonly a: Point;
  readonly b: Point;
  /** Whether it belongs to what is selected or pointed at. */
  readonly strong: boolean;
  readonly touching: boolean;
}

export interface GraphNode {
  readonly at: Point;
  readonly strong: boolean;
}

/** How far two hulls that nearly touch are apart, and where that is written. */
export interface Gap {
  readonly at: Point;
  /** [m] */
  readonly gap: number;
}

export class ContactGraph {
  readonly object = new Group();
  private readonly dots: Points<BufferGeometry, ShaderMaterial>;
  private readonly lines: { strokes: Strokes; wants: (line: GraphLine) => boolean; tone: "text" | "selected" | "warn" }[];

  constructor(private ink: ThemeColors) {
    const one = (tone: "text" | "selected" | "warn", width: number, dash: number, opacity: number, strong: boolean) => ({
      strokes: new Strokes(ink[tone], { width, dash, opacity, over: true }, 4),
      wants: (line: GraphLine) => line.strong === strong && line.touching === (dash === 0),
      tone,
    });
    this.lines = [
      one("text", 1.4, 0, 0.55, false),
      one("warn", 1, 4, 0.7, false),
      one("selected", 2.6, 0, 1, true),
      one("warn", 1.8, 4, 1, true),
    ];
    this.dots = new Points(new BufferGeometry(), this.dotMaterial());
    this.dots.renderOrder = 5;
    this.dots.frustumCulled = false;
    this.object.add(...this.lines.map(({ strokes }) => strokes.object), this.dots);
  }

  set(nodes: readonly GraphNode[], lines: readonly GraphLine[]): void {
    for (const { strokes, wants } of this.lines) strokes.set(linesBetween(lines.filter(wants).map(({ a, b }) => [a, b])));
    this.dots.geometry.dispose();
    this.dots.geometry = new BufferGeometry();
    const at = new Float32Array(nodes.flatMap((node) => node.at));
    const strong = new Float32Array(nodes.map((node) => (node.strong ? 1 : 0)));
    this.dots.geometry.setAttribute("position", new BufferAttribute(at, 3));
    this.dots.geometry.setAttribute("strong", new BufferAttribute(strong, 1));
  }

  setInk(ink: ThemeColors): void {
    this.ink = ink;
    for (const { strokes, tone } of this.lines) strokes.recolor(ink[tone]);
    this.dots.material = this.dotMaterial();
  }

  measure(frame: Frame): void {
    for (const { strokes } of this.lines) strokes.measure(frame);
    const { size } = this.dots.material.uniforms;
    if (size) size.value = 8 * frame.pixel;
  }

  dispose(): void {
    for (const { strokes } of this.lines) strokes.dispose();
    this.dots.geometry.dispose();
  }

  private dotMaterial(): ShaderMaterial {
    const { text, selected, pale } = this.ink;
    return new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { size: { value: 8 }, plain: { value: text }, strong: { value: selected }, rim: { value: pale } },
      depthTest: false,
      transparent: true,
    });
  }
}
