// The one mutable place where the picture lives; React and the stores tell it what changed, it draws.
import { type Camera, Matrix4, OrthographicCamera, Vector3, type WebGLRenderer } from "three";
import type { EditedPacket, ShapesPacket } from "../../server/packet";
import type { Scene } from "../../store/scenes";
import { View } from "../camera/view";
import { ContactGraph, type GraphLine, type GraphNode } from "../drawing/contacts";
import { CutPlane } from "../drawing/cutPlane";
import { Ground } from "../drawing/ground";
import { type Ink, readInk } from "../drawing/ink";
import type { Appearance } from "../drawing/looks";
import { Made } from "../drawing/made";
import { extentOf, pointsOf, Side } from "../drawing/side";
import { Surfaces } from "../drawing/surface";
import type { Point } from "../shapes/merged";
import type { Eye } from "../shapes/silhouette";
import { turnedBox } from "../shapes/turned";
import { drawPanes, MANY_LINES } from "./draw";
import { Pace } from "./pace";
import { type Pane, paneAt, panesOf } from "./panes";
import type { Settings } from "./settings";

const MANY_PIXELS = 1.2e6;

export class Stage {
  readonly view = new View();
  readonly ground = new Ground();
  readonly graph: ContactGraph;
  readonly cut: CutPlane;
  ink: Ink = readInk();
  shown: Side | null = null;
  before: Side | null = null;
  made: Made | null = null;
  ghost: Surfaces | null = null;
  width = 0;
  height = 0;
  /** Pixels of the drawing for one of the page. */
  pixel = 1;
  coarse = false;
  frames = 0;
  gl: WebGLRenderer | null = null;
  /** Asks for a frame. */
  invalidate: () => void = () => undefined;
  private screenPixel = 1;
  private readonly pace = new Pace(() => this.invalidate());
  private centre: Point = [0, 0, 0];
  private wantsFit = false;
  private compiled = false;
  private readonly drawn = new Set<() => void>();

  /** smooth: whether the canvas itself smooths edges. */
  constructor(
    public settings: Settings,
    private readonly smooth: boolean,
  ) {
    this.graph = new ContactGraph(this.ink);
    this.cut = new CutPlane(this.ink);
  }

  /** Shows a scene; another asset is framed, from the side that one looked from. */
  show(scene: Scene | null): void {
    const isOther = scene?.asset !== this.shown?.scene.asset;
    if (scene && !isOther && this.shown?.adopt(scene)) return this.invalidate();
    this.shown?.dispose();
    if (isOther) this.setGhost(null);
    if (isOther && scene) this.arrive(scene);
    this.shown = scene ? new Side(scene, this.centre, this.ink) : null;
    this.shown?.turned.add(this.graph.object, this.cut.object);
    if (this.ghost) this.shown?.turned.add(this.ghost.object);
    this.invalidate();
  }

  compareWith(scene: Scene | null): void {
    this.before?.dispose();
    this.before = scene ? new Side(scene, this.centre, this.ink) : null;
    this.invalidate();
  }

  preview(packet: EditedPacket | null): void {
    this.made?.object.removeFromParent();
    this.made?.dispose();
    this.made = packet && this.shown ? new Made(packet, this.centre, this.ink) : null;
    if (this.made) this.shown?.turned.add(this.made.object);
    this.invalidate();
  }

  showMade(on: boolean): void {
    if (this.made) this.made.object.visible = on;
  }

  setGhost(packet: ShapesPacket | null): void {
    this.ghost?.object.removeFromParent();
    this.ghost?.dispose();
    const rows = packet?.rows.flatMap((row, k) => {
      const shape = packet.shapes[k];
      return shape ? [{ name: row.name, shape }] : [];
    });
    this.ghost = rows ? new Surfaces(rows, this.ink.text, 0.16) : null;
    if (this.ghost) this.shown?.turned.add(this.ghost.object);
    this.invalidate();
  }

  setGraph(nodes: readonly GraphNode[], lines: readonly GraphLine[]): void {
    this.graph.set(nodes, lines);
    this.invalidate();
  }

  paint(shown: Appearance, before: Appearance): void {
    this.shown?.paint(shown);
    this.before?.paint(before);
    this.invalidate();
  }

  set(settings: Settings): void {
    this.settings = settings;
    this.view.explode = settings.explode;
    this.view.projection = settings.projection;
    this.invalidate();
  }

  setInk(ink: Ink): void {
    this.ink = ink;
    this.shown?.setInk(ink);
    this.before?.setInk(ink);
    this.graph.setInk(ink);
    this.cut.setInk(ink);
    this.ghost?.recolor(ink.text);
    this.ground.fit(this.view.bounds, ink);
    this.invalidate();
  }

  resize(width: number, height: number, pixel: number): void {
    [this.width, this.height, this.screenPixel] = [width, height, pixel];
    this.invalidate();
  }

  /** Frames all, or some hulls; at once where `now` is null. */
  frame(names: ReadonlySet<string> | null, now: number | null): void {
    const points = this.shown ? pointsOf(this.shown, names?.size ? names : null, this.settings.explode) : [];
    if (points.length) this.view.fit(points, now);
    this.invalidate();
  }

  panes(): Pane[] {
    const { compare, divider } = this.settings;
    return panesOf(compare, this.before !== null, divider, this.width);
  }

  paneAt(x: number): Pane {
    return paneAt(this.panes(), x);
  }

  sideOf(pane: Pane): Side | null {
    return pane.which === "before" ? this.before : this.shown;
  }

  /** Where a point of the file's frame is seen in a pane, in pixels of the viewport. */
  pixelOf(point: Point, pane: Pane): { x: number; y: number } {
    const at = new Vector3(...point);
    if (this.shown) at.applyMatrix4(this.shown.turned.matrix);
    const { x, y } = this.view.pixelOf(at);
    return { x: x + pane.x, y };
  }

  /** Where one looks from, in the frame of the file. */
  eye(camera: Camera): Eye {
    const parallel = camera instanceof OrthographicCamera;
    const back = this.shown?.turned.matrix.clone().invert() ?? new Matrix4();
    const at = parallel ? camera.getWorldDirection(new Vector3()).negate() : camera.position.clone();
    return { at: (parallel ? at.transformDirection(back) : at.applyMatrix4(back)).toArray(), parallel };
  }

  /** Calls back after each frame, until the returned function is called. */
  onDrawn(listener: () => void): () => void {
    this.drawn.add(listener);
    return () => this.drawn.delete(listener);
  }

  draw(gl: WebGLRenderer, now: number): void {
    this.gl = gl;
    this.refine(gl, this.pace.begin(now));
    const panes = this.panes();
    this.view.resize(panes[0]?.width ?? this.width, this.height);
    if (this.wantsFit && this.height > 0) {
      this.wantsFit = false;
      this.frame(null, null);
    }
    const moves = this.view.advance(now);
    drawPanes(gl, this, panes);
    // so that the first selection does not wait for shaders
    if (!this.compiled && this.shown) gl.compile(this.shown.root, this.view.camera());
    this.compiled ||= this.shown !== null;
    this.frames++;
    for (const listener of this.drawn) listener();
    if (moves) this.moveCamera(() => undefined);
  }

  /** Does something to the camera. */
  moveCamera(change: (view: View) => void): void {
    change(this.view);
    this.pace.move(performance.now() / 1000);
    this.invalidate();
  }

  dispose(): void {
    this.pace.stop();
    this.show(null);
    this.compareWith(null);
    this.preview(null);
    this.graph.dispose();
    this.cut.dispose();
    this.ground.dispose();
  }

  /** Draws with a share of the pixels, and without thin lines where that is below 1. */
  private refine(gl: WebGLRenderer, share: number): void {
    this.coarse = share < 1;
    const isLight = (this.shown?.hulls.sharpEdges ?? 0) < MANY_LINES && this.width * this.height < MANY_PIXELS;
    // where the canvas does not smooth edges, light scenes are drawn larger and shrunk
    const finest = !this.smooth && isLight ? Math.max(2, this.screenPixel) : this.screenPixel;
    const pixel = share * finest;
    if (pixel !== gl.getPixelRatio()) gl.setPixelRatio(pixel);
    this.pixel = pixel;
  }

  private arrive(scene: Scene): void {
    this.pace.restart();
    const box = extentOf(scene) ?? [-0.5, -0.5, 0, 0.5, 0.5, 1];
    const mid = (axis: number) => ((box[axis] ?? 0) + (box[axis + 3] ?? 0)) / 2;
    this.centre = [mid(0), mid(1), mid(2)];
    this.view.bounds = turnedBox(box, scene.view.upright);
    this.ground.fit(this.view.bounds, this.ink);
    this.wantsFit = true;
  }
}
