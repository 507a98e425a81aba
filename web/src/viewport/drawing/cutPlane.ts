// The cutting plane: a translucent square, the contour of the cut, and an arrow each way to slide it.
import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { CutPlane as Plane } from "../../store/cut";
import type { Shape } from "../../server/packet";
import type { ThemeColors } from "./themeColors";
import { type Frame, linesBetween, Strokes } from "./strokes";

export class CutPlaneDrawing {
  readonly object = new Group();
  private readonly square: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly lines: Strokes;

  constructor(ink: ThemeColors) {
    const material = new MeshBasicMaterial({
      color: ink.accent,
      opacity: 0.2,
      transparent: true,
      side: DoubleSide,
      depthWrite: false,
    });
    this.square = new Mesh(new BufferGeometry(), material);
    this.square.frustumCulled = false;
    this.square.renderOrder = 6;
    this.lines = new Strokes(ink.accent, { width: 2, behind: 0.55 }, 7);
    this.object.add(this.square, this.lines.object);
    this.object.visible = false;
  }

  /** Shows the plane through a shape; null takes it away. away: where the exploded view has moved the hull. */
  set(plane: Plane | null, shape: Shape | null, away: readonly number[]): void {
    this.object.visible = plane !== null && shape !== null;
    if (!plane || !shape) return;
    this.object.position.set(away[0] ?? 0, away[1] ?? 0, away[2] ?? 0);
    const [at, across] = [new Vector3(...plane.at), new Vector3(...plane.across)];
    const corners = cornersAround(shape, at, across);
    this.square.geometry.dispose();
    this.square.geometry = new BufferGeometry();
    this.square.geometry.setAttribute("position", new BufferAttribute(numbers(corners), 3));
    this.square.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const rim = corners.map((corner, k): [Vector3, Vector3] => [corner, corners[(k + 1) % 4] ?? corner]);
    const tip = across.clone().multiplyScalar(0.32 * plane.span);
    const arrow: [Vector3, Vector3] = [at.clone().sub(tip), at.clone().add(tip)];
    this.lines.set(linesBetween([...rim, arrow, ...contour(shape, at, across)].map(([a, b]) => [a.toArray(), b.toArray()])));
  }

  setInk(ink: ThemeColors): void {
    this.square.material.color = ink.accent;
    this.lines.recolor(ink.accent);
  }

  measure(frame: Frame): void {
    this.lines.measure({ ...frame, explode: 0 });
  }

  dispose(): void {
    this.square.geometry.dispose();
    this.square.material.dispose();
    this.lines.dispose();
  }
}

/** The corners of a square in the plane that is larger than the shape's shadow on it. */
function cornersAround(shape: Shape, at: Vector3, across: Vector3): Vector3[] {
  const helper = Math.abs(across.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  const u = helper.cross(across).normalize();
  const v = across.clone().cross(u);
  const along = (axis: Vector3) => pointsOf(shape).map((p) => p.sub(at).dot(axis));
  const [us, vs] = [along(u), along(v)].map((row) => [Math.min(...row), Math.max(...row)] as const);
  const margin = 0.12 * Math.max((us?.[1] ?? 0) - (us?.[0] ?? 0), (vs?.[1] ?? 0) - (vs?.[0] ?? 0));
  const corner = (a: number, b: number) =>
    at
      .clone()
      .addScaledVector(u, (us?.[a] ?? 0) + (a ? margin : -margin))
      .addScaledVector(v, (vs?.[b] ?? 0) + (b ? margin : -margin));
  return [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
}

/** Where the plane meets the triangles of the shape. */
function contour(shape: Shape, at: Vector3, across: Vector3): [Vector3, Vector3][] {
  const points = pointsOf(shape);
  const heights = points.map((point) => point.clone().sub(at).dot(across));
  const out: [Vector3, Vector3][] = [];
  for (let k = 0; k < shape.index.length; k += 3) {
    const corners = [shape.index[k] ?? 0, shape.index[k + 1] ?? 0, shape.index[k + 2] ?? 0];
    const met = corners.flatMap((a, c) => {
      const b = corners[(c + 1) % 3] ?? 0;
      const [h, i, p, q] = [heights[a] ?? 0, heights[b] ?? 0, points[a], points[b]];
      return h > 0 !== i > 0 && p && q ? [p.clone().lerp(q, h / (h - i))] : [];
    });
    if (met[0] && met[1]) out.push([met[0], met[1]]);
  }
  return out;
}

function pointsOf({ positions }: Shape): Vector3[] {
  return Array.from({ length: positions.length / 3 }, (_, k) => new Vector3().fromArray(positions, 3 * k));
}

const numbers = (points: readonly Vector3[]): Float32Array => new Float32Array(points.flatMap((p) => p.toArray()));
