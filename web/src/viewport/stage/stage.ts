// The one mutable place where the picture lives; React and the stores change it, it draws.
import { type Camera, Matrix4, OrthographicCamera, Vector2, Vector3, type WebGLRenderer } from "three";
import { freeRoom, type Rect, type Room, shapeOf, wholeRoom } from "../camera/fit";
import { CameraView } from "../camera/view";
import { type AssetDrawing, pointsOf } from "../drawing/assetDrawing";
import { clippingPlane, frameOf } from "../drawing/section";
import type { Gap } from "../drawing/contactGraph";
import type { Eye } from "../geometry/edges";
import type { Point } from "../geometry/triangles";
import type { Scene } from "../../store/scenes";
import { type SectionPlane, spanOfBox } from "../../store/section";
import { findViewpoint } from "./viewpoint";
import { Contents } from "./contents";
import { FrameRate } from "./frameRate";
import { type Pane, paneAt, panesOf, type Settings } from "./panes";

const MANY_PIXELS = 1.2e6;

export class Stage {
  readonly view = new CameraView();
  readonly contents = new Contents();
  width = 0;
  height = 0;
  /** Pixels of the drawing for one of the page. */
  pixel = 1;
  coarse = false;
  frames = 0;
  /** Of near misses that are pointed at. */
  gaps: readonly Gap[] = [];
  gl: WebGLRenderer | null = null;
  /** The section plane in the canonical frame, null for none. */
  section: SectionPlane | null = null;
  /** Asks for a frame. */
  invalidate: () => void = () => undefined;
  /** What lies over the picture [px]. */
  covers: () => readonly Rect[] = () => [];
  private screenPixel = 1;
  private readonly pace: FrameRate;
  /** Whether there is time for shadows in this frame. */
  hasTime = true;
  private wantsFit = false;
  /** The panes and their sizes as they were drawn last. */
  private layout = "";
  /** Hulls to be looked at as soon as their asset is shown. */
  private wanted: { asset: string; names: ReadonlySet<string> } | null = null;
  private readonly drawnSize = new Vector2();
  private readonly drawn = new Set<() => void>();

  /** smooth: whether the canvas itself smooths edges. */
  constructor(
    public settings: Settings,
    private readonly smooth: boolean,
  ) {
    this.pace = new FrameRate(() => this.invalidate(), !smooth);
  }

  get shown(): AssetDrawing | null {
    return this.contents.shown;
  }

  /** Changes what is in the picture. */
  change(change: (contents: Contents) => void): void {
    change(this.contents);
    this.invalidate();
  }

  /** Shows a scene; another asset, or another axis up, is framed, from the side that one looked from. */
  show(scene: Scene | null): void {
    const yUp = this.shown?.scene.view.y_up;
    const isOther = this.contents.show(scene);
    this.view.bounds = this.contents.bounds;
    this.project();
    this.invalidate();
    if (scene && scene.view.y_up !== yUp) this.wantsFit = true;
    if (!isOther || !scene) return;
    this.pace.restart();
    this.pace.settle(performance.now() / 1000);
    this.wantsFit = true;
    if (this.wanted?.asset !== scene.asset) this.wanted = null;
  }

  set(settings: Settings): void {
    this.settings = settings;
    this.view.explode = settings.explode;
    this.project();
    this.invalidate();
  }

  /** Assets side by side are seen in parallel projection, so that their sizes compare. */
  private project(): void {
    this.view.projection = this.shown?.scene.parts ? "orthographic" : this.settings.projection;
  }

  /** The box around all there is, where the exploded view has moved it, in the canonical frame. */
  get extent(): number[] {
    const { bounds } = this.contents;
    const grown = (axis: number, end: number): number => {
      const middle = ((bounds[axis] ?? 0) + (bounds[axis + 3] ?? 0)) / 2;
      return middle + (1 + this.settings.explode) * ((bounds[end] ?? 0) - middle);
    };
    return [0, 1, 2, 3, 4, 5].map((end) => grown(end % 3, end));
  }

  /** How far the extent reaches across the section plane [m]. */
  get sectionSpan(): number {
    const [low, high] = this.section ? spanOfBox(this.extent, this.section.normal) : [0, 0];
    return high - low;
  }

  /** Cuts the picture open; null closes it. */
  cutOpen(section: SectionPlane | null): void {
    this.section = section;
    this.change((contents) => contents.section.set(frameOf(section, this.extent)));
  }

  resize(width: number, height: number, pixel: number): void {
    [this.width, this.height, this.screenPixel] = [width, height, pixel];
    this.invalidate();
  }

  /** Frames all, or some hulls, where nothing lies over the picture; at once where `now` is null. */
  frame(names: ReadonlySet<string> | null, now: number | null): void {
    const some = names?.size ? names : null;
    const sides = this.panes().flatMap((pane) => this.sideOf(pane) ?? []);
    const points = [...new Set(sides)].flatMap((side) => pointsOf(side, some, this.settings.explode));
    if (points.length) this.view.fit(points, now, this.room(points));
    this.view.fitsAll = some === null;
    this.invalidate();
  }

  /** The part of a pane in which points are largest beside what lies over the picture, in all panes alike. */
  private room(points: readonly Point[]): Room {
    const panes = this.panes();
    const width = panes[0]?.width ?? 0;
    if (width === 0 || this.height === 0) return wholeRoom(this.view.aspect);
    const covers = this.covers().flatMap((one) => panes.map(({ x }) => ({ ...one, left: one.left - x, right: one.right - x })));
    return freeRoom(width, this.height, covers, shapeOf(this.view.pose, points));
  }

  /** Looks at some hulls of an asset, which may be on its way yet. */
  lookAt(asset: string, names: ReadonlySet<string>): void {
    this.wanted = { asset, names };
    this.invalidate();
  }

  panes(): Pane[] {
    const { compare, divider } = this.settings;
    return panesOf(compare, this.contents.before !== null, divider, this.width);
  }

  paneAt(x: number): Pane {
    return paneAt(this.panes(), x);
  }

  sideOf(pane: Pane): AssetDrawing | null {
    return pane.which === "before" ? this.contents.before : this.shown;
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
    this.hasTime = this.pace.hasTime(now);
    const panes = this.panes();
    this.view.resize(panes[0]?.width ?? this.width, this.height);
    const layout = `${panes.map(({ which, width }) => `${which} ${width}`)} ${this.height}`;
    const changed = layout !== this.layout && this.view.fitsAll;
    this.layout = layout;
    if ((this.wantsFit || changed) && this.height > 0) {
      this.wantsFit = false;
      this.frame(null, null);
    }
    this.approach(now);
    const moves = this.view.advance(now);
    drawPanes(gl, this, panes);
    this.frames++;
    for (const listener of this.drawn) listener();
    if (moves) this.moveCamera(() => undefined);
  }

  /** Does something to the camera. */
  moveCamera(change: (view: CameraView) => void): void {
    change(this.view);
    this.pace.move(performance.now() / 1000);
    this.invalidate();
  }

  dispose(): void {
    this.pace.stop();
    this.contents.dispose();
  }

  private approach(now: number): void {
    if (!this.wanted || this.wanted.asset !== this.shown?.scene.asset || this.height === 0) return;
    const pose = findViewpoint(this, this.wanted.names, this.room(pointsOf(this.shown, this.wanted.names, this.settings.explode)));
    this.wanted = null;
    if (pose) this.view.glideTo(pose, now);
  }

  /** Draws with a share of the pixels, and without thin lines where that is below 1. */
  private refine(gl: WebGLRenderer, share: number): void {
    this.coarse = share < 1;
    const isLight = (this.shown?.hulls.sharpEdges ?? 0) < MANY_LINES && this.width * this.height < MANY_PIXELS;
    // where the canvas does not smooth edges, light scenes are drawn larger and shrunk
    const finest = !this.smooth && isLight ? Math.max(2, this.screenPixel) : this.screenPixel;
    const pixel = share * finest;
    const size = gl.getSize(this.drawnSize);
    const same = size.x === this.width && size.y === this.height && gl.getPixelRatio() === pixel;
    if (!same) gl.setDrawingBufferSize(this.width, this.height, pixel);
    this.pixel = pixel;
  }
}

/** Draws the panes of the picture, each with the same camera, clipped to its part. */
function drawPanes(gl: WebGLRenderer, stage: Stage, panes: readonly Pane[]): void {
  gl.autoClear = false;
  gl.setScissorTest(false);
  gl.setViewport(0, 0, stage.width, stage.height);
  gl.clear();
  gl.setScissorTest(panes.length > 1);
  for (const pane of panes) drawPane(gl, stage, pane);
}

function drawPane(gl: WebGLRenderer, stage: Stage, pane: Pane): void {
  const side = stage.sideOf(pane);
  const camera = stage.view.camera();
  const { settings, height, pixel } = stage;
  gl.setViewport(pane.x, 0, pane.width, height);
  gl.setScissor(pane.clip[0], 0, pane.clip[1] - pane.clip[0], height);
  const frame = { width: pane.width, height, pixel, explode: settings.explode, eye: stage.eye(camera) };
  gl.clippingPlanes = [];
  if (settings.grid) gl.render(stage.contents.ground.scene, camera);
  if (!side) return;
  prepare(stage, side);
  side.measure(frame, stage.section);
  stage.contents.graph.measure(frame);
  stage.contents.cut.measure(frame);
  stage.contents.section.measure(frame);
  stage.contents.made?.measure(frame);
  if (stage.section) gl.clippingPlanes = [clippingPlane(stage.section)];
  shade(gl, stage, side, pane.width, camera);
  gl.render(side.root, camera);
}

/** Shadows between hulls and on the ground; a wireframe has none. */
function shade(gl: WebGLRenderer, stage: Stage, { occlusion, shadow }: AssetDrawing, width: number, camera: Camera): void {
  const { settings: { explode, wireframe }, height, contents: { bounds, ink }, hasTime } = stage;
  if (wireframe) {
    occlusion.hide();
    shadow.hide();
    return;
  }
  // it knows nothing of faces that close what is cut open
  if (stage.section) occlusion.hide();
  else occlusion.update(gl, camera, { width, height, explode, radius: stage.view.radius }, hasTime);
  shadow.update(gl, bounds, explode, ink.dark, hasTime);
}

/** Edges from which on a scene is too much for thin lines where drawing is slow. */
const MANY_LINES = 6000;

function prepare({ settings, contents: { graph, ghost }, coarse }: Stage, side: AssetDrawing): void {
  side.hulls.setWireframe(settings.wireframe, coarse && side.hulls.sharpEdges > MANY_LINES);
  side.opaque.object.visible = settings.opaque;
  graph.object.visible = settings.contacts;
  if (ghost) ghost.object.visible = settings.ghost;
}
