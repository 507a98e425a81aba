// One state of the asset in three.js: its hulls with outlines and shadows, non-convex pieces, ghost, contact graph.
import { Group, Scene as ThreeScene, Vector3 } from "three";
import { boxAround, boxOf, matrixOf, type Point, triangleAt } from "../geometry/triangles";
import type { Shape } from "../../server/packet";
import type { Scene } from "../../store/scenes";
import type { SectionPlane } from "../../store/section";
import { plus } from "../../store/vectors";
import { AmbientOcclusion } from "./ambientOcclusion";
import { GroundShadow } from "./groundShadow";
import { type Appearance, hullLooks } from "./hullLooks";
import { HullSet } from "./hullSet";
import { dressed, outlineColors, type OutlineName } from "./outlines";
import { planeIn, SectionFaces } from "./section";
import { type Frame, type Strokes } from "./strokes";
import { Surfaces } from "./surface";
import type { ThemeColors } from "./themeColors";

export class AssetDrawing {
  readonly root = new ThreeScene();
  /** Holds what is in the frame of the file. */
  readonly turned = new Group();
  readonly hulls: HullSet;
  readonly opaque: Surfaces;
  readonly occlusion: AmbientOcclusion;
  readonly shadow: GroundShadow;
  /** They close the hulls where the section plane cuts them. */
  readonly closed: SectionFaces;
  private selection: ReadonlySet<string> = new Set();
  private readonly outlines: Readonly<Record<Exclude<OutlineName, "made">, Strokes>>;

  constructor(
    public scene: Scene,
    readonly centre: Point,
    ink: ThemeColors,
  ) {
    this.turned.matrixAutoUpdate = false;
    this.turned.matrix.copy(matrixOf(scene.view.upright));
    this.hulls = new HullSet(scene.hulls, centre, ink);
    this.closed = new SectionFaces(this.hulls, ink);
    this.opaque = new Surfaces(scene.opaque, ink.unlabelled, 0.34);
    const one = (name: OutlineName) => dressed(name, ink);
    this.outlines = { lit: one("lit"), removed: one("removed"), selected: one("selected"), hover: one("hover") };
    const strokes = Object.values(this.outlines).map(({ object }) => object);
    this.turned.add(this.hulls.object, this.closed.object, this.opaque.object, ...strokes);
    this.occlusion = new AmbientOcclusion(this.hulls);
    this.shadow = new GroundShadow(this.hulls);
    this.root.add(this.turned, this.occlusion.object, this.shadow.object);
    this.root.updateMatrixWorld(true);
  }

  /** Takes over a scene of the same shapes, as after labelling; whether it could. */
  adopt(scene: Scene): boolean {
    const { hulls, opaque, view } = this.scene;
    const same =
      scene.hulls.length === hulls.length &&
      scene.hulls.every((hull, k) => hull.shape === hulls[k]?.shape && hull.name === hulls[k].name) &&
      scene.opaque.every((piece, k) => piece.shape === opaque[k]?.shape) &&
      String(scene.view.upright) === String(view.upright);
    if (same) this.scene = scene;
    return same;
  }

  paint(now: Appearance): void {
    const looks = hullLooks(this.scene, now);
    this.hulls.paint((k) => looks[k] as NonNullable<(typeof looks)[number]>);
    const { selection, going, hover } = now;
    this.selection = selection;
    const shown = (names: Iterable<string>) => this.hulls.outlines(names);
    this.outlines.selected.set(shown([...selection].filter((name) => !going.has(name))));
    this.outlines.lit.set(shown([...now.lit].filter((name) => name !== hover && !selection.has(name))));
    this.outlines.hover.set(hover === null || selection.has(hover) ? [] : shown([hover]));
    this.outlines.removed.set(shown(going));
    this.opaque.point(hover);
  }

  setInk(ink: ThemeColors): void {
    this.hulls.setInk(ink);
    this.closed.setInk(ink);
    this.opaque.recolor(ink.unlabelled);
    for (const [name, strokes] of Object.entries(this.outlines)) strokes.recolor(...outlineColors(name as OutlineName, ink));
  }

  /** To be called before drawing; section: in the canonical frame. */
  measure(frame: Frame, section: SectionPlane | null = null): void {
    this.hulls.measure(frame.pixel, frame.explode);
    this.closed.set(section && planeIn(section, this.turned.matrix), frame.explode, this.selection);
    this.closed.measure(frame);
    for (const strokes of Object.values(this.outlines)) strokes.measure(frame);
  }

  dispose(): void {
    this.hulls.dispose();
    this.closed.dispose();
    this.opaque.dispose();
    this.occlusion.dispose();
    this.shadow.dispose();
    for (const strokes of Object.values(this.outlines)) strokes.dispose();
  }
}

/** The box around all hulls and non-convex pieces, in the frame of the file; null where there is nothing. */
export function extentOf({ hulls, opaque }: Scene): readonly number[] | null {
  const boxes = new Float32Array([...hulls, ...opaque].flatMap(({ shape }) => boxOf(shape.positions)));
  return boxAround(boxes, [...hulls, ...opaque].keys());
}

/** The vertices of hulls and non-convex pieces where they are shown, in the canonical frame; null: of all in sight. */
export function pointsOf(side: AssetDrawing, only: ReadonlySet<string> | null, explode: number): Point[] {
  const { hulls, opaque } = side.scene;
  const out: Point[] = [];
  const at = new Vector3();
  const add = ({ positions }: Shape, away: Point): void => {
    for (let k = 0; k < positions.length; k += 3) {
      at.fromArray(positions, k).addScaledVector(new Vector3(...away), explode);
      out.push(at.applyMatrix4(side.turned.matrix).toArray());
    }
  };
  hulls.forEach(({ name, shape }, k) => {
    const wanted = only ? only.has(name) : side.hulls.visible[k];
    if (wanted) add(shape, side.hulls.aways[k] ?? [0, 0, 0]);
  });
  if (!only) opaque.forEach(({ shape }) => add(shape, [0, 0, 0]));
  return out;
}

/** The middle of a hull, and of each of its triangles. */
export function* spotsOf({ hulls }: AssetDrawing, place: number, explode: number): Generator<Point> {
  yield hulls.middle(place, explode);
  const { faces, index, positions } = hulls.shapes;
  const away = hulls.aways[place] ?? [0, 0, 0];
  for (let face = faces[place] ?? 0; face < (faces[place + 1] ?? 0); face++) {
    yield plus(triangleAt(positions, index, face).getMidpoint(new Vector3()).toArray(), away, explode);
  }
}
