// What each tool does with the left button: clicks select, paint or mark; drags draw a box or lasso, paint, or move the
// cutting plane.
import { Vector3 } from "three";
import { castRayThrough } from "../geometry/ray";
import type { Spot } from "../geometry/region";
import { clearRegion, setRegion } from "../stage/regionStore";
import { hullAt, pieceAt, rayAt } from "../stage/picking";
import type { Stage } from "../stage/stage";
import { hullsToPaint } from "../../store/alike";
import { hullToCut, planeOf, setCut, shareAt, useCut } from "../../store/cut";
import { ORIGIN, plus, type Triple, type Vec } from "../../store/vectors";
import { endStroke, paint } from "../../store/labels";
import type { SceneHull } from "../../store/scenes";
import { dropPoints, pointRuler, takePoint } from "../../store/ruler";
import { hover, select, selectMore, useWorkspace } from "../../store/workspace";
import { beginStroke } from "./brush";
import type { Drag, PointerTool } from "./gestures";
import { beginRegion } from "./regions";
import { snapAt } from "./snap";

export function createPointerTool(stage: Stage): PointerTool {
  return {
    begin: (spot, event) => {
      const { tool, brush } = useWorkspace.getState();
      if (tool === "box" || tool === "lasso") return beginRegion(stage, tool, spot, event);
      if (tool === "cut") return beginCut(stage, spot);
      return tool === "select" && brush !== null ? beginStroke(stage, spot) : null;
    },
    click: createClick(stage),
    hover: (spot) => {
      if (isMeasuring()) pointRuler(spot && snapAt(stage, ...spot));
      hover(spot && pieceAt(stage, ...spot));
    },
    drawsRegion: () => ["box", "lasso"].includes(useWorkspace.getState().tool),
  };
}

const isMeasuring = (): boolean => useWorkspace.getState().tool === "ruler";

/** Clicks farther apart than this are not in one place [px]. */
const SAME_PLACE = 3;

/** Clicks on hulls. One with Alt, or again in the same place while one selects through, goes to the next hull behind. */
function createClick(stage: Stage): PointerTool["click"] {
  let last: { spot: Spot; name: string | null } = { spot: [-99, -99], name: null };
  return (spot, event) => {
    const { tool, brush, through, selection } = useWorkspace.getState();
    if (tool === "ruler") return measureAt(stage, ...spot);
    const isAgain = Math.hypot(spot[0] - last.spot[0], spot[1] - last.spot[1]) <= SAME_PLACE;
    const isPlain = tool !== "landmark" && tool !== "cut" && !(tool === "select" && brush !== null);
    if (!isPlain || !(event.altKey || (through && isAgain))) {
      last = { spot, name: hullAt(stage, ...spot) };
      return handleClick(last.name, event);
    }
    const behind = hullsThrough(stage, spot);
    const from = isAgain && last.name !== null ? last.name : behind.find((name) => selection.has(name));
    const name = behind[(behind.indexOf(from ?? "") + 1) % Math.max(behind.length, 1)] ?? null;
    // what the click before added is not meant any more
    if (isAgain && event.shiftKey && last.name !== null && name !== last.name) selectMore([last.name], "subtract");
    last = { spot, name };
    handleClick(name, event);
  };
}

/** The hulls that the line of sight meets, from the front to the back. */
function hullsThrough(stage: Stage, [x, y]: Spot): string[] {
  const side = stage.sideOf(stage.paneAt(x));
  if (!side) return [];
  const { shapes, visible, aways, names } = side.hulls;
  return castRayThrough(shapes, rayAt(stage, x, y), visible, aways, stage.settings.explode).flatMap(({ place }) => names[place] ?? []);
}

/** A click of the ruler: a point on a hull; on nothing, the first point is dropped. */
function measureAt(stage: Stage, x: number, y: number): void {
  const point = snapAt(stage, x, y);
  if (!point) return dropPoints();
  if (stage.shown) takePoint(stage.shown.scene, point);
}

/** A click on a hull, or on nothing. */
function handleClick(name: string | null, { shiftKey, ctrlKey, metaKey, altKey }: MouseEvent): void {
  const { tool, brush } = useWorkspace.getState();
  if (tool === "landmark") return name === null ? undefined : addLandmark(name);
  if (tool === "cut") return name === null ? undefined : select([name]);
  if (tool === "select" && brush !== null) return name === null ? undefined : paintAlike(name, altKey);
  if (name !== null) selectMore([name], shiftKey ? "add" : ctrlKey || metaKey ? "toggle" : "replace");
  else if (!shiftKey && !ctrlKey && !metaKey) select([]);
}

/** Paints a hull and what is outlined as its look-alikes, or it alone, by one edit. */
function paintAlike(name: string, alone: boolean): void {
  paint(hullsToPaint(name, alone));
  endStroke();
}

/** The first click is where the direction starts, the second where it ends; a third begins anew. */
function addLandmark(name: string): void {
  const { landmarks } = useWorkspace.getState();
  useWorkspace.setState({ landmarks: landmarks.length === 1 ? [...landmarks, name] : [name] });
}

/** Moving the cutting plane by hand: slid along its axis, or drawn as a line across the hull. */
function beginCut(stage: Stage, start: Spot): Drag | null {
  const hull = hullToCut(stage.shown?.scene ?? null, useWorkspace.getState().selection);
  if (!hull) return null;
  if (useCut.getState().axis === "free") return beginLine(stage, hull, start);
  return hullAt(stage, ...start) === hull.name ? beginSlide(stage, hull, start) : null;
}

/** The plane goes with the pointer along its axis. */
function beginSlide(stage: Stage, hull: SceneHull, start: Spot): Drag | null {
  const scene = stage.shown?.scene;
  const plane = scene ? planeOf(scene, hull, useCut.getState()) : null;
  const pane = stage.panes().at(-1);
  if (!plane || !pane) return null;
  const before = useCut.getState().share;
  const ahead = plus(plane.at, plane.across, plane.span);
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
      setRegion({ drawn: [start, spot] });
      const last = rayAt(stage, ...spot);
      const between = new Vector3(...last.from).addScaledVector(new Vector3(...last.along), stage.view.radius);
      const across = between.sub(new Vector3(...first.from)).cross(new Vector3(...first.along)).normalize();
      if (across.lengthSq() < 0.5) return;
      const drawn = across.toArray() as Triple;
      setCut({ drawn, share: shareAt(hull, drawn, unexploded(stage, hull, first.from)) });
    },
    end: clearRegion,
    cancel: clearRegion,
  };
}

/** A point of the file's frame where the hull is when it is not moved by the exploded view. */
function unexploded(stage: Stage, hull: SceneHull, at: Vec): Triple {
  const k = stage.shown?.hulls.places.get(hull.name) ?? -1;
  return plus(at, stage.shown?.hulls.aways[k] ?? ORIGIN, -stage.settings.explode);
}
