// The grid on the ground and the three axes, fitted to the size of the asset; they fade towards the rim.
import { BufferAttribute, BufferGeometry, Color, Group, LineSegments, Scene, ShaderMaterial } from "three";
import { axisShown } from "../../store/vectors";
import type { ThemeColors } from "./themeColors";

const AXES = [new Color("#d4503f"), new Color("#5a9e3a"), new Color("#3f7ad4")] as const;

const VERTEX = /* glsl */ `
  in vec4 tone;
  out vec4 ink;
  out vec2 spot;
  void main() {
    ink = tone;
    spot = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }
`;

const FRAGMENT = /* glsl */ `
  precision highp float;
  in vec4 ink;
  in vec2 spot;
  uniform vec2 middle;
  uniform float rim;
  void main() {
    gl_FragColor = vec4(ink.rgb, ink.a * (1.0 - smoothstep(0.35, 1.0, length(spot - middle) / rim)));
    #include <colorspace_fragment>
  }
`;

export class Ground {
  readonly scene = new Scene();
  /** Between two lines [m]. */
  step = 1;
  private readonly root = new Group();

  constructor() {
    this.scene.add(this.root);
  }

  /** Lies below a box, given by its lowest and highest corner, in the frame that is shown; yUp: whether Y is up there. */
  fit(box: readonly number[], ink: ThemeColors, yUp = false): void {
    this.dispose();
    const [x0, y0, z0, x1, y1, z1] = box as [number, number, number, number, number, number];
    const size = Math.max(x1 - x0, y1 - y0, 0.5 * (z1 - z0), 1e-6);
    this.step = niceStep(size / 7);
    const middle = [snap((x0 + x1) / 2, this.step), snap((y0 + y1) / 2, this.step)] as const;
    const rim = Math.ceil((1.15 * size) / this.step) * this.step;
    const level = z0 - 0.0005 * size;
    this.root.add(lines(gridOf(middle, rim, this.step, level, ink), middle, rim));
    this.root.add(lines(axesAt(level, 0.35 * size, yUp), middle, 4 * rim));
  }

  dispose(): void {
    for (const one of [...this.root.children] as LineSegments[]) {
      one.geometry.dispose();
      this.root.remove(one);
    }
  }
}

/** Rows of x, y, z, r, g, b, opacity. */
type Rows = number[][];

function gridOf(middle: readonly [number, number], rim: number, step: number, z: number, ink: ThemeColors): Rows {
  const count = Math.round(rim / step);
  const rows: Rows = [];
  for (let k = -count; k <= count; k++) {
    const [x, y] = [middle[0] + k * step, middle[1] + k * step];
    const strong = (at: number) => (Math.round(at / step) % 5 === 0 ? 0.75 : 0.34);
    const tone = (at: number) => [...ink.line.toArray(), strong(at)];
    rows.push([x, middle[1] - rim, z, ...tone(x)], [x, middle[1], z, ...tone(x)]);
    rows.push([x, middle[1], z, ...tone(x)], [x, middle[1] + rim, z, ...tone(x)]);
    rows.push([middle[0] - rim, y, z, ...tone(y)], [middle[0], y, z, ...tone(y)]);
    rows.push([middle[0], y, z, ...tone(y)], [middle[0] + rim, y, z, ...tone(y)]);
  }
  return rows;
}

function axesAt(z: number, length: number, yUp: boolean): Rows {
  return AXES.flatMap((color, k) => {
    const end = axisShown((["x", "y", "z"] as const)[k] ?? "x", yUp).map((value, c) => length * value + (c === 2 ? z : 0));
    return [
      [0, 0, z, ...color.toArray(), 1],
      [...end, ...color.toArray(), 1],
    ];
  });
}

function lines(rows: Rows, middle: readonly [number, number], rim: number): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(rows.flatMap((row) => row.slice(0, 3))), 3));
  geometry.setAttribute("tone", new BufferAttribute(new Float32Array(rows.flatMap((row) => row.slice(3))), 4));
  const uniforms = { middle: { value: middle }, rim: { value: rim } };
  const out = new LineSegments(
    geometry,
    new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms,
      transparent: true,
      depthWrite: false,
    }),
  );
  out.frustumCulled = false;
  return out;
}

const snap = (value: number, step: number): number => Math.round(value / step) * step;

/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
export function niceStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  const times = length / power;
  return (times >= 5 ? 5 : times >= 2 ? 2 : 1) * power;
}
