// The cutting plane: a translucent square, the contour of the cut, and an arrow each way to slide it.
import { BufferGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { CutPlane as Plane } from "../../store/cut";
import type { SectionPlane } from "../../store/section";
import { dot, plus } from "../../store/vectors";
import type { Shape } from "../../server/packet";
import { cutPolygon } from "../geometry/section";
import { mergeShapes } from "../geometry/triangles";
import { frameCorners, sidesOf } from "./section";
import type { ThemeColors } from "./themeColors";
import { type Frame, linesBetween, Strokes } from "./strokes";

export class CutPlaneDrawing {
  readonly object = new Group();
  private readonly square: Mesh<BufferGeometry, MeshBasicMaterial>;
  private readonly lines: Strokes;

  constructor(ink: ThemeColors) {
    const material = new MeshBasicMaterial({ color: ink.accent, opacity: 0.2, transparent: true, side: DoubleSide, depthWrite: false });
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
    const at: SectionPlane = { normal: plane.across, at: dot(plane.at, plane.across) };
    const merged = mergeShapes([shape]);
    const corners = frameCorners(at, [...merged.boxes]);
    this.square.geometry.dispose();
    this.square.geometry = new BufferGeometry().setFromPoints(corners.map((corner) => new Vector3(...corner)));
    this.square.geometry.setIndex([0, 1, 2, 0, 2, 3]);
    const tip = (by: number) => plus(plane.at, plane.across, by * plane.span);
    this.lines.set(linesBetween([...sidesOf(corners), [tip(-0.32), tip(0.32)], ...sidesOf(cutPolygon(merged, 0, at, [0, 0, 0]))]));
  }

  setInk(ink: ThemeColors): void {
    this.square.material.color = ink.accent;
    this.lines.recolor(ink.accent);
  }

  measure(frame: Frame): void {
    this.lines.measure(frame);
  }

  dispose(): void {
    this.square.geometry.dispose();
    this.square.material.dispose();
    this.lines.dispose();
  }
}
