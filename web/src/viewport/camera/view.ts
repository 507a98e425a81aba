// What the camera sees now: its pose, moves that are under way, and the way between pixels and rays.
import { Vector3, type OrthographicCamera, type PerspectiveCamera } from "three";
import type { StandardView } from "../../store/desk";
import { Cameras, type Projection } from "./cameras";
import { Glide } from "./glide";
import { fitted, from, orbited, panned, type Pose, START, type Vec, zoomed } from "./pose";

/** A line from the eye into the scene, in the canonical frame. */
export interface Sight {
  readonly from: Vec;
  readonly along: Vec;
}

export class View {
  pose: Pose = START;
  projection: Projection = "perspective";
  /** Of one pane [px]. */
  width = 0;
  height = 0;
  /** The box around all there is, in the canonical frame. */
  bounds: readonly number[] = [-1, -1, -1, 1, 1, 1];
  explode = 0;
  private glide: Glide | null = null;
  private readonly cameras = new Cameras();
  private placed: { key: string; camera: PerspectiveCamera | OrthographicCamera } | null = null;

  get aspect(): number {
    return this.height > 0 ? this.width / this.height : 1;
  }

  /** Half the diagonal of the bounds [m]. */
  get radius(): number {
    const [x0, y0, z0, x1, y1, z1] = this.bounds as [number, number, number, number, number, number];
    return Math.max(0.5 * Math.hypot(x1 - x0, y1 - y0, z1 - z0), 1e-6);
  }

  /** Moves on; whether a move is still under way. */
  advance(now: number): boolean {
    if (!this.glide) return false;
    const { pose, done } = this.glide.at(now);
    this.pose = pose;
    if (done) this.glide = null;
    return !done;
  }

  lookFrom(side: StandardView, now: number): void {
    this.go(from(this.pose, side), now);
  }

  /** Shows all of some points; at once, or as a move that begins now. */
  fit(points: readonly Vec[], now: number | null): void {
    const pose = fitted(this.pose, points, this.aspect, this.projection === "perspective");
    if (now === null) this.jump(pose);
    else this.go(pose, now);
  }

  /** Moves to a pose, from now on. */
  glideTo(pose: Pose, now: number): void {
    this.go(pose, now);
  }

  /** Of one pane; one that becomes narrower shows as much as before from side to side, and the other way round. */
  resize(width: number, height: number): void {
    const was = Math.min(this.aspect, 1.2);
    const known = this.width > 0 && this.height > 0;
    [this.width, this.height] = [width, height];
    const is = Math.min(this.aspect, 1.2);
    if (known && was !== is) this.pose = { ...this.pose, height: (this.pose.height * was) / is };
  }

  /** By a drag of so many pixels. */
  orbit(dx: number, dy: number): void {
    this.jump(orbited(this.pose, -dx * 0.0085, dy * 0.0085));
  }

  pan(dx: number, dy: number): void {
    this.jump(panned(this.pose, dx / this.height, -dy / this.height));
  }

  /** Nearer by a factor below 1, towards a pixel of the pane. */
  zoom(factor: number, x: number, y: number): void {
    const [right, up] = [(x - this.width / 2) / this.height, (this.height / 2 - y) / this.height];
    this.jump(zoomed(this.pose, factor, right, up, [this.radius * 2e-3, this.radius * 40]));
  }

  camera(): PerspectiveCamera | OrthographicCamera {
    const [x0, y0, z0, x1, y1, z1] = this.bounds as [number, number, number, number, number, number];
    const { target } = this.pose;
    const off = Math.hypot(target[0] - (x0 + x1) / 2, target[1] - (y0 + y1) / 2, target[2] - (z0 + z1) / 2);
    const reach = off + 2.5 * this.radius * (1 + this.explode);
    const key = JSON.stringify([this.pose, this.projection, this.aspect, reach]);
    if (this.placed?.key !== key) {
      this.placed = { key, camera: this.cameras.placed(this.pose, this.projection, this.aspect, reach) };
    }
    return this.placed.camera;
  }

  sightAt(x: number, y: number): Sight {
    const camera = this.camera();
    const spot = [(2 * x) / this.width - 1, 1 - (2 * y) / this.height] as const;
    const near = new Vector3(...spot, -1).unproject(camera);
    const far = new Vector3(...spot, 1).unproject(camera).sub(near);
    return { from: near.toArray(), along: far.normalize().toArray() };
  }

  /** Where a point is seen, in pixels of the pane. */
  pixelOf(point: Vector3): { x: number; y: number } {
    const at = point.clone().project(this.camera());
    return { x: ((at.x + 1) / 2) * this.width, y: ((1 - at.y) / 2) * this.height };
  }

  private go(pose: Pose, now: number): void {
    this.glide = Glide.start(this.pose, pose, now);
  }

  private jump(pose: Pose): void {
    this.glide = null;
    this.pose = pose;
  }
}
