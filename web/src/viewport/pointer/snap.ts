// The point of a hull that the ruler takes under the pointer: a corner where one is near, else an edge, else the face.
import { Matrix4, Vector4 } from "three";
import type { AssetDrawing } from "../drawing/assetDrawing";
import { planeIn } from "../drawing/section";
import { EDGE, type Eye } from "../geometry/edges";
import { beyond, castThrough } from "../geometry/section";
import type { Point } from "../geometry/triangles";
import type { Pane } from "../stage/panes";
import { rayAt } from "../stage/picking";
import type { Stage } from "../stage/stage";
import type { RulerPoint } from "../../store/ruler";
import { dot, minus, plus } from "../../store/vectors";

const CORNER_NEAR = 10; // px
const EDGE_NEAR = 7;
/** Candidates of which one is looked for that nothing hides. */
const TRIES = 8;

interface Candidate {
  readonly place: number;
  /** Where it is drawn, in the frame of the file. */
  readonly at: Point;
  readonly snap: "corner" | "edge";
  /** From the pointer [px]. */
  readonly far: number;
}

/** Null where there is no hull near. */
export function snapAt(stage: Stage, x: number, y: number): RulerPoint | null {
  const pane = stage.paneAt(x);
  const side = stage.sideOf(pane);
  if (!side) return null;
  const found = candidates(stage, side, pane, [x - pane.x, y])
    .sort((a, b) => Number(a.snap === "edge") - Number(b.snap === "edge") || a.far - b.far)
    .slice(0, TRIES)
    .find((one) => isSeen(stage, side, pane, one.at));
  if (found) return pointOf(stage, side, found.place, found.at, found.snap);
  const ray = rayAt(stage, x, y);
  const met = castThrough(side.hulls, ray, stage.settings.explode, planeOf(stage, side));
  return met && pointOf(stage, side, met.place, plus(ray.from, ray.along, met.distance), "face");
}

function pointOf({ settings }: Stage, { hulls }: AssetDrawing, place: number, at: Point, snap: RulerPoint["snap"]): RulerPoint {
  const own = plus(at, hulls.aways[place] ?? [0, 0, 0], -settings.explode);
  return { hull: hulls.names[place] ?? "", at: [...own], snap };
}

const planeOf = ({ section }: Stage, side: AssetDrawing) => section && planeIn(section, side.turned.matrix);

/** Corners and sharp edges near a pixel of the pane, on the sides of hulls that look at the eye. */
function candidates(stage: Stage, side: AssetDrawing, pane: Pane, spot: readonly [number, number]): Candidate[] {
  const { hulls } = side;
  const eye = stage.eye(stage.view.camera());
  const project = projection(stage, side, pane);
  const out: Candidate[] = [];
  hulls.names.forEach((_, place) => {
    const edges = hulls.edges[place];
    if (!hulls.visible[place] || !edges) return;
    const away = hulls.aways[place] ?? [0, 0, 0];
    for (let e = 0; e < edges.sharp * EDGE; e += EDGE) {
      const a = plus(pointIn(edges.records, e), away, stage.settings.explode);
      if (!looksAtEye(edges.records, e, a, eye)) continue;
      const b = plus(pointIn(edges.records, e + 3), away, stage.settings.explode);
      out.push(...nearestOnEdge(place, a, b, project(a), project(b), spot));
    }
  });
  return out;
}

const pointIn = (records: Float32Array, at: number): Point => [records[at] ?? 0, records[at + 1] ?? 0, records[at + 2] ?? 0];

/** Whether a face beside an edge does. */
function looksAtEye(records: Float32Array, e: number, at: Point, eye: Eye): boolean {
  const to: Point = eye.parallel ? eye.at : minus(eye.at, at);
  return [6, 9].some((side) => dot(pointIn(records, e + side), to) > 0);
}

interface Projected {
  readonly x: number;
  readonly y: number;
  /** Its depth in perspective, 1 in parallel projection. */
  readonly w: number;
}

/** From the frame of the file to pixels of the pane. */
function projection(stage: Stage, side: AssetDrawing, pane: Pane): (point: Point) => Projected {
  const camera = stage.view.camera();
  const matrix = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(side.turned.matrix);
  const at = new Vector4();
  return (point) => {
    at.set(...point, 1).applyMatrix4(matrix);
    return { x: ((at.x / at.w + 1) / 2) * pane.width, y: ((1 - at.y / at.w) / 2) * stage.height, w: at.w };
  };
}

function nearestOnEdge(place: number, a: Point, b: Point, p: Projected, q: Projected, [x, y]: readonly [number, number]): Candidate[] {
  if (p.w <= 0 || q.w <= 0) return [];
  const corners = [{ at: a, far: Math.hypot(p.x - x, p.y - y) }, { at: b, far: Math.hypot(q.x - x, q.y - y) }];
  const out = corners.filter(({ far }) => far < CORNER_NEAR).map((one): Candidate => ({ ...one, place, snap: "corner" }));
  const [dx, dy] = [q.x - p.x, q.y - p.y];
  const share = ((x - p.x) * dx + (y - p.y) * dy) / (dx * dx + dy * dy || 1);
  const far = Math.hypot(p.x + share * dx - x, p.y + share * dy - y);
  if (share <= 0 || share >= 1 || far >= EDGE_NEAR) return out;
  // what is halfway on the screen is nearer to the end that is nearer to the eye
  const along = (share * p.w) / ((1 - share) * q.w + share * p.w);
  const at = plus(a, minus(b, a), along);
  return [...out, { place, at, snap: "edge", far }];
}

/** Whether no hull and no section plane hides a point. */
function isSeen(stage: Stage, side: AssetDrawing, pane: Pane, at: Point): boolean {
  const plane = planeOf(stage, side);
  const slack = 1e-3 * stage.view.radius;
  if (plane && beyond(plane, at) > slack) return false;
  const { x, y } = projection(stage, side, pane)(at);
  const ray = rayAt(stage, x + pane.x, y);
  const distance = dot(minus(at, ray.from), ray.along);
  const met = castThrough(side.hulls, ray, stage.settings.explode, plane);
  return !met || met.distance >= distance - slack;
}
