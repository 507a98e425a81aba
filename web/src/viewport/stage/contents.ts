// What is in the picture: both sides of the asset, the preview, the ghost, the contact graph, the ground.
import { AssetDrawing, extentOf } from "../drawing/assetDrawing";
import { ContactGraph } from "../drawing/contactGraph";
import { CutPlaneDrawing } from "../drawing/cutPlane";
import { Ground } from "../drawing/ground";
import type { Appearance } from "../drawing/hullLooks";
import { PreviewHulls } from "../drawing/previewHulls";
import { Strokes } from "../drawing/strokes";
import { Surfaces } from "../drawing/surface";
import { readThemeColors, type ThemeColors } from "../drawing/themeColors";
import { type Point, rotateBox } from "../geometry/triangles";
import type { EditedPacket, ShapesPacket } from "../../server/packet";
import type { Scene } from "../../store/scenes";

const NOTHING = [-0.5, -0.5, 0, 0.5, 0.5, 1];
const GHOST = 0.16;

export class Contents {
  ink: ThemeColors = readThemeColors();
  readonly ground = new Ground();
  readonly graph = new ContactGraph(this.ink);
  readonly cut = new CutPlaneDrawing(this.ink);
  /** The frame of the section plane, in the canonical frame. */
  readonly section = new Strokes(this.ink.accent, { width: 1.5, behind: 0.35 }, 7);
  shown: AssetDrawing | null = null;
  before: AssetDrawing | null = null;
  made: PreviewHulls | null = null;
  ghost: Surfaces | null = null;
  /** The box around all there is, in the canonical frame. */
  bounds: readonly number[] = NOTHING;
  private centre: Point = [0, 0, 0];

  /** Shows a scene; whether it is of another asset than before. */
  show(scene: Scene | null): boolean {
    const last = this.shown?.scene;
    const beside = (one?: Scene | null) => String(one?.parts?.map(({ asset, scale }) => [asset, scale]));
    const isOther = scene?.asset !== last?.asset || beside(scene) !== beside(last);
    if (scene && !isOther && this.shown?.adopt(scene)) return false;
    this.shown?.dispose();
    if (isOther) {
      this.setGhost(null);
      this.compareWith(null);
    }
    if (scene && (isOther || String(scene.view.upright) !== String(last?.view.upright))) this.survey(scene, isOther);
    this.shown = scene ? new AssetDrawing(scene, this.centre, this.ink) : null;
    this.shown?.turned.add(this.graph.object, this.cut.object);
    this.shown?.root.add(this.section.object);
    if (this.ghost) this.shown?.turned.add(this.ghost.object);
    return isOther;
  }

  compareWith(scene: Scene | null): void {
    this.before?.dispose();
    this.before = scene ? new AssetDrawing(scene, this.centre, this.ink) : null;
  }

  preview(packet: EditedPacket | null): void {
    this.made?.object.removeFromParent();
    this.made?.dispose();
    this.made = packet && this.shown ? new PreviewHulls(packet, this.centre, this.ink) : null;
    if (this.made) this.shown?.turned.add(this.made.object);
  }

  setGhost(packet: ShapesPacket | null): void {
    this.ghost?.object.removeFromParent();
    this.ghost?.dispose();
    const rows = packet?.rows.flatMap((row, k) => {
      const shape = packet.shapes[k];
      return shape ? [{ name: row.name, shape }] : [];
    });
    this.ghost = rows ? new Surfaces(rows, this.ink.text, GHOST) : null;
    if (this.ghost) this.shown?.turned.add(this.ghost.object);
  }

  paint(shown: Appearance, before: Appearance): void {
    this.shown?.paint(shown);
    this.before?.paint(before);
  }

  setInk(ink: ThemeColors): void {
    this.ink = ink;
    this.shown?.setInk(ink);
    this.before?.setInk(ink);
    this.graph.setInk(ink);
    this.cut.setInk(ink);
    this.section.recolor(ink.accent);
    this.ghost?.recolor(ink.text);
    this.ground.fit(this.bounds, ink, this.shown?.scene.view.y_up);
  }

  dispose(): void {
    this.show(null);
    this.preview(null);
    this.graph.dispose();
    this.cut.dispose();
    this.section.dispose();
    this.ground.dispose();
  }

  /** Takes the measure of an asset; what hulls drift away from stays while it is the same. */
  private survey(scene: Scene, isOther: boolean): void {
    const box = extentOf(scene) ?? NOTHING;
    const mid = (axis: number) => ((box[axis] ?? 0) + (box[axis + 3] ?? 0)) / 2;
    if (isOther) this.centre = [mid(0), mid(1), mid(2)];
    this.bounds = rotateBox(box, scene.view.upright);
    this.ground.fit(this.bounds, this.ink, scene.view.y_up);
  }
}
