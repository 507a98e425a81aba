// From where to look at some hulls: a side from which they are seen, near enough to tell them, with what is around them.
import { Vector3 } from "three";
import { fit, type Room } from "../camera/fit";
import { axesOf, distanceOf, orbit, type Pose } from "../camera/pose";
import type { CameraView } from "../camera/view";
import { type AssetDrawing, pointsOf, spotsOf } from "../drawing/assetDrawing";
import { castRay } from "../geometry/ray";
import type { Point } from "../geometry/triangles";
import { minus, plus } from "../../store/vectors";
import type { Settings } from "./panes";

/** Turns to try, sideways and up: the present side first, so that one is not led about without need. */
const TURNS: readonly (readonly [number, number])[] = [
  [0, 0],
  ...[0.7, -0.7, 1.4, -1.4, 2.1, -2.1, Math.PI].map((turn) => [turn, 0] as const),
  [0, 0.8],
  [0, -0.9],
  [Math.PI, -0.9],
];
/** Of a hull, that is to be seen. */
const ENOUGH = 0.3;
const SPOTS = 30;
/** The least height of the picture, in heights of the one that shows the whole asset. */
const SURROUNDINGS = 0.55;

/** What is looked at now, and from where. */
interface Sight {
  readonly shown: AssetDrawing | null;
  readonly view: CameraView;
  readonly settings: Settings;
}

/** The pose that shows them in a part of the picture, null where nothing of the hulls is there. */
export function findViewpoint({ shown, view, settings }: Sight, names: ReadonlySet<string>, room: Room): Pose | null {
  const own = shown ? pointsOf(shown, names, settings.explode) : [];
  if (!shown || !own.length) return null;
  const all = pointsOf(shown, null, settings.explode);
  const spots = spotsOn(shown, names, settings.explode);
  let best: { pose: Pose; share: number } | null = null;
  for (const [sideways, up] of TURNS) {
    const turned = orbit(view.pose, sideways, up);
    const fitTo = (points: readonly Point[]) => fit(turned, points, room, view.projection === "perspective");
    const near = fitTo(own);
    const pose = { ...near, height: Math.max(near.height, SURROUNDINGS * fitTo(all).height) };
    const share = shareSeen(shown, spots, pose, settings.explode);
    if (share >= ENOUGH) return pose;
    if (!best || share > best.share) best = { pose, share };
  }
  return best?.pose ?? null;
}

interface Spot {
  readonly place: number;
  readonly at: Point;
}

/** Spots on some hulls, evenly chosen of many. */
function spotsOn(side: AssetDrawing, names: ReadonlySet<string>, explode: number): Spot[] {
  const places = [...names].flatMap((name) => side.hulls.places.get(name) ?? []);
  const all = places.flatMap((place) => [...spotsOf(side, place, explode)].map((at) => ({ place, at })));
  const step = Math.max(1, all.length / SPOTS);
  return Array.from({ length: Math.min(all.length, SPOTS) }, (_, k) => all[Math.floor(k * step)] as Spot);
}

/** Of some spots, those that no other hull lies before. */
function shareSeen({ hulls, turned }: AssetDrawing, spots: readonly Spot[], pose: Pose, explode: number): number {
  const eye = new Vector3(...plus(pose.target, axesOf(pose).eye, distanceOf(pose)));
  const from = eye.applyMatrix4(turned.matrix.clone().invert()).toArray();
  const seen = spots.filter(({ place, at }) => {
    return castRay(hulls.shapes, { from, along: minus(at, from) }, hulls.visible, hulls.aways, explode)?.place === place;
  });
  return spots.length ? seen.length / spots.length : 0;
}
