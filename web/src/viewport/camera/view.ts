// What the camera sees now: its pose, moves that are under way, the three.js cameras, and the way between pixels and
// rays.
import { Matrix4, OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from "three";
import { plus, type Vec } from "../../store/vectors";
import type { StandardView } from "../../store/workspace";
import { fit, type Room, wholeRoom } from "./fit";
import { axesOf, distanceOf, FIELD, interpolate, lookFromSide, orbit, pan, type Pose, START, zoom } from "./pose";

/** A line from the eye into the scene, in the canonical frame. */
interface SightLine {
  readonly from: Vec;
  readonly along: Vec;
}

export class CameraView {
  pose: Pose = START;
  projection: Projection = "perspective";
  /** Of one pane [px]. */
  width = 0;
  height = 0;
  /** The box around all there is, in the canonical frame. */
  bounds: readonly number[] = [-1, -1, -1, 1, 1, 1];
  explode = 0;
  /** Whether all is shown as `fit` has placed it: the person did not come nearer or go elsewhere since. */
  fitsAll = false;
  /** A short smooth move from one pose to another [s]. */
  private glide: { from: Pose; to: Pose; began: number } | null = null;
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
    const { from, to, began } = this.glide;
    const share = Math.min(1, (now - began) / SECONDS);
    this.pose = share < 1 ? interpolate(from, to, 1 - (1 - share) ** 3) : to;
    if (share >= 1) this.glide = null;
    return share < 1;
  }

  lookFrom(side: StandardView, now: number): void {
    this.go(lookFromSide(this.pose, side), now);
  }

  /** Shows all of some points in a part of the picture; at once, or as a move that begins now. */
  fit(points: readonly Vec[], now: number | null, room: Room = wholeRoom(this.aspect)): void {
    const pose = fit(this.pose, points, room, this.projection === "perspective");
    if (now === null) this.jump(pose);
    else this.go(pose, now);
  }

  /** Moves to a pose, from now on. */
  glideTo(pose: Pose, now: number): void {
    this.fitsAll = false;
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
    this.jump(orbit(this.pose, -dx * 0.0085, dy * 0.0085));
  }

  pan(dx: number, dy: number): void {
    this.fitsAll = false;
    this.jump(pan(this.pose, dx / this.height, -dy / this.height));
  }

  /** Nearer by a factor below 1, towards a pixel of the pane. */
  zoom(factor: number, x: number, y: number): void {
    const [right, up] = [(x - this.width / 2) / this.height - this.pose.shift[0], (this.height / 2 - y) / this.height - this.pose.shift[1]];
    this.fitsAll = false;
    this.jump(zoom(this.pose, factor, right, up, [this.radius * 2e-3, this.radius * 40]));
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

  sightAt(x: number, y: number): SightLine {
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
    // over at once where motion is to be reduced
    const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.glide = { from: this.pose, to: pose, began: isStill ? -Infinity : now };
  }

  private jump(pose: Pose): void {
    this.glide = null;
    this.pose = pose;
  }
}

/** How long a move takes [s]. */
const SECONDS = 0.22;

type Projection = "perspective" | "orthographic";

/** The two three.js cameras, both placed by one pose, so that switching keeps what is seen. */
class Cameras {
  private readonly perspective = new PerspectiveCamera((FIELD * 180) / Math.PI);
  private readonly orthographic = new OrthographicCamera();

  /** The camera at a pose; reach: how far from the target anything is that is to be seen. */
  placed(pose: Pose, projection: Projection, aspect: number, reach: number): PerspectiveCamera | OrthographicCamera {
    const camera = projection === "perspective" ? this.perspective : this.orthographic;
    const { right, up, eye } = axesOf(pose);
    const distance = projection === "perspective" ? distanceOf(pose) : reach + pose.height;
    camera.position.set(...plus(pose.target, eye, distance));
    const basis = new Matrix4().makeBasis(new Vector3(...right), new Vector3(...up), new Vector3(...eye));
    camera.quaternion.copy(new Quaternion().setFromRotationMatrix(basis));
    camera.far = distance + reach;
    camera.near = Math.max(distance - reach, projection === "perspective" ? distance * 0.02 : 0);
    if (camera instanceof OrthographicCamera) {
      [camera.top, camera.bottom] = [pose.height / 2, -pose.height / 2];
      [camera.right, camera.left] = [camera.top * aspect, camera.bottom * aspect];
    }
    camera.setViewOffset(aspect, 1, -pose.shift[0], pose.shift[1], aspect, 1);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }
}
