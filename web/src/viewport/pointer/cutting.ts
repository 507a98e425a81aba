// Moving the cutting plane by hand: slid along its axis, or drawn as a line across the hull.
import { Vector3 } from "three";
import { hullToCut, planeOf, setCut, shareAt, type Triple, useCutting } from "../../store/cutting";
import { useDesk } from "../../store/desk";
import type { SceneHull } from "../../store/scenes";
import type { Spot } from "../picking/region";
import { hullAt, rayAt } from "../stage/picking";
import { point, pointNowhere } from "../stage/pointing";
import type { Stage } from "../stage/stage";
import type { Drag } from "./gestures";

export function beginCut(stage: Stage, start: Spot): Drag | null {
  const hull = hullToCut(stage.shown?.scene ?? null, useDesk.getState().selection);
  if (!hull) return null;
  if (useCutting.getState().axis === "free") return beginLine(stage, hull, start);
  return hullAt(stage, ...start) === hull.name ? beginSlide(stage, hull, start) : null;
}

/** The plane goes with the pointer along its axis. */
function beginSlide(stage: Stage, hull: SceneHull, start: Spot): Drag | null {
  const scene = stage.shown?.scene;
  const plane = scene ? planeOf(scene, hull, useCutting.getState()) : null;
  const pane = stage.panes().at(-1);
  if (!plane || !pane) return null;
  const before = useCutting.getState().share;
  const ahead = plane.at.map((value, k) => value + plane.span * (plane.across[k] ?? 0)) as Triple;
  const [a, b] = [stage.pixelOf(plane.at, pane), stage.pixelOf(ahead, pane)];
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const length = Math.max(dx * dx + dy * dy, 100);
  return {
    move: ([x, y]) => setCut({ share: before + ((x - start[0]) * dx + (y - start[1]) * dy) / length }),
    end: () => undefined,
    cancel: () => undefined,
  };
}

/** The plane goes through the line that is drawn and through the eye. */
function beginLine(stage: Stage, hull: SceneHull, start: Spot): Drag {
  const first = rayAt(stage, ...start);
  return {
    move: (spot) => {
      point({ drawn: [start, spot] });
      const last = rayAt(stage, ...spot);
      const between = new Vector3(...last.from).addScaledVector(new Vector3(...last.along), stage.view.radius);
      const across = between.sub(new Vector3(...first.from)).cross(new Vector3(...first.along)).normalize();
      if (across.lengthSq() < 0.5) return;
      const drawn = across.toArray() as Triple;
      setCut({ drawn, share: shareAt(hull, drawn, onHull(stage, hull, first.from)) });
    },
    end: pointNowhere,
    cancel: pointNowhere,
  };
}

/** A point of the file's frame where the hull is when it is not moved by the exploded view. */
function onHull(stage: Stage, hull: SceneHull, at: readonly number[]): number[] {
  const k = stage.shown?.hulls.places.get(hull.name) ?? -1;
  const away = stage.shown?.hulls.aways[k] ?? [0, 0, 0];
  return at.map((value, axis) => value - stage.settings.explode * (away[axis] ?? 0));
}
