// What each tool does with the left button: clicks select, paint or mark; drags draw a box or lasso, move the cutting
// plane, or paint.
import { Vector3 } from "three";
import { cornersOf } from "../camera/pose";
import type { AssetDrawing } from "../drawing/assetDrawing";
import { drawHullIds } from "../drawing/hullIds";
import { planeIn } from "../drawing/section";
import { boxRegion, isInside, placesInside, type Region, type Spot } from "../geometry/region";
import { beyond } from "../geometry/section";
import type { Point } from "../geometry/triangles";
import { clearRegion, setRegion, useRegion } from "../stage/regionStore";
import type { Pane } from "../stage/panes";
import { hullAt, pieceAt, rayAt } from "../stage/picking";
import type { Stage } from "../stage/stage";
import { hullToCut, planeOf, setCut, shareAt, type Triple, useCut } from "../../store/cut";
import { paint } from "../../store/labels";
import type { SceneHull } from "../../store/scenes";
import { dropPoints, pointRuler, takePoint } from "../../store/ruler";
import { hover, select, selectMore, setTool, useWorkspace } from "../../store/workspace";
import type { Drag, PointerTool } from "./gestures";
import { snapAt } from "./snap";

export function createPointerTool(stage: Stage): PointerTool {
  return {
    begin: (spot, event) => {
      const { tool, brush } = useWorkspace.getState();
      if (tool === "box" || tool === "lasso") return beginRegion(stage, tool, spot, event);
      if (tool === "cut") return beginCut(stage, spot);
      return tool === "select" && brush !== null ? beginStroke(stage, ...spot) : null;
    },
    click: ([x, y], event) => (isMeasuring() ? measureAt(stage, x, y) : handleClick(hullAt(stage, x, y), event)),
    hover: (spot) => {
      if (isMeasuring()) pointRuler(spot && snapAt(stage, ...spot));
      hover(spot && pieceAt(stage, ...spot));
    },
    drawsRegion: () => ["box", "lasso"].includes(useWorkspace.getState().tool),
  };
}

const isMeasuring = (): boolean => useWorkspace.getState().tool === "ruler";

/** A click of the ruler: a point on a hull; on nothing, the first point is dropped. */
function measureAt(stage: Stage, x: number, y: number): void {
  const point = snapAt(stage, x, y);
  if (!point) return dropPoints();
  if (stage.shown) takePoint(stage.shown.scene, point);
}

/** A click on a hull, or on nothing. */
function handleClick(name: string | null, { shiftKey, ctrlKey, metaKey }: MouseEvent): void {
  const { tool, brush } = useWorkspace.getState();
  if (tool === "landmark") return name === null ? undefined : addLandmark(name);
  if (tool === "cut") return name === null ? undefined : select([name]);
  if (tool === "select" && brush !== null) return name === null ? undefined : paint([name]);
  if (name !== null) selectMore([name], shiftKey ? "add" : ctrlKey || metaKey ? "toggle" : "replace");
  else if (!shiftKey && !ctrlKey && !metaKey) select([]);
}

/** The first click is where the direction starts, the second where it ends; a third begins anew. */
function addLandmark(name: string): void {
  const { landmarks } = useWorkspace.getState();
  useWorkspace.setState({ landmarks: landmarks.length === 1 ? [...landmarks, name] : [name] });
}

/** A stroke of the brush over hulls; on nothing, the camera moves instead. */
function beginStroke(stage: Stage, x: number, y: number): Drag | null {
  const first = hullAt(stage, x, y);
  if (first === null) return null;
  const done = new Set([first]);
  const over = (name: string | null): void => {
    if (name === null || done.has(name)) return;
    done.add(name);
    paint([name]);
  };
  let began = false;
  return {
    move: ([nextX, nextY]) => {
      if (!began) paint([first]);
      began = true;
      const name = hullAt(stage, nextX, nextY);
      hover(name);
      over(name);
    },
    end: () => undefined,
    cancel: () => undefined,
  };
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
function unexploded(stage: Stage, hull: SceneHull, at: readonly number[]): number[] {
  const k = stage.shown?.hulls.places.get(hull.name) ?? -1;
  const away = stage.shown?.hulls.aways[k] ?? [0, 0, 0];
  return at.map((value, axis) => value - stage.settings.explode * (away[axis] ?? 0));
}

/** Begins a region; with shift it adds, with ctrl it toggles, with Alt it takes away, and the tool stays in hand. */
function beginRegion(stage: Stage, tool: "box" | "lasso", start: Spot, pressed: PointerEvent): Drag | null {
  const pane = stage.paneAt(start[0]);
  const side = stage.sideOf(pane);
  if (!side) return null;
  const finder = finderOf(stage, side, pane);
  let drawn: Region = [start];
  return {
    move: (spot) => {
      drawn = tool === "box" ? boxRegion(start, spot) : extendLasso(drawn, spot);
      setRegion({ drawn, region: finder(drawn) });
    },
    end: (event) => {
      const { region } = useRegion.getState();
      const how = selectionMode(pressed, event);
      selectMore(region, how);
      clearRegion();
      if (how === "replace" && useWorkspace.getState().tool === tool) setTool("select");
    },
    cancel: clearRegion,
  };
}

const STEP = 3;

function extendLasso(drawn: Region, spot: Spot): Region {
  const last = drawn.at(-1) ?? spot;
  return Math.hypot(spot[0] - last[0], spot[1] - last[1]) < STEP ? drawn : [...drawn, spot];
}

function selectionMode(pressed: PointerEvent, event: PointerEvent): "replace" | "add" | "toggle" | "subtract" {
  const held = (key: "altKey" | "shiftKey" | "ctrlKey" | "metaKey") => pressed[key] || event[key];
  if (held("altKey")) return "subtract";
  if (held("shiftKey")) return "add";
  return held("ctrlKey") || held("metaKey") ? "toggle" : "replace";
}

/** Finds the names of hulls in a region, in the picture as it is now. */
function finderOf(stage: Stage, side: AssetDrawing, pane: Pane): (region: Region) => ReadonlySet<string> {
  const { hulls } = side;
  const [width, height] = [Math.ceil(pane.width), Math.ceil(stage.height)];
  const places = stage.gl ? drawHullIds(stage.gl, hulls, side.closed.geometry, stage.view.camera(), width, height) : new Uint32Array();
  const spots = vertexSpots(stage, side, pane);
  return (region) => {
    const inPane = region.map(([x, y]): Spot => [x - pane.x, y]);
    const found = placesInside(inPane, places, width, height);
    hulls.names.forEach((_, k) => {
      if (hulls.visible[k] && !found.has(k) && !isCutAway(stage, side, k) && spots[k]?.every((spot) => isInside(region, spot))) found.add(k);
    });
    return new Set([...found].flatMap((k) => hulls.names[k] ?? []));
  };
}

/** Whether the whole box of a hull is beyond the section plane. */
function isCutAway({ section, settings }: Stage, { hulls, turned }: AssetDrawing, k: number): boolean {
  return section !== null && boxCorners(hulls, k, settings.explode).every((corner) => beyond(planeIn(section, turned.matrix), corner) > 0);
}

/** The corners of the box of a hull where it is shown. */
function boxCorners({ shapes, aways }: AssetDrawing["hulls"], k: number, explode: number): Point[] {
  return cornersOf([...shapes.boxes.subarray(6 * k, 6 * k + 6)]).map(([x, y, z]) => {
    const away = aways[k] ?? [0, 0, 0];
    return [x + explode * away[0], y + explode * away[1], z + explode * away[2]] as const;
  });
}

/** Where the corners of each hull's box are seen. */
function vertexSpots(stage: Stage, { hulls }: AssetDrawing, pane: Pane): Spot[][] {
  return hulls.names.map((_, k) =>
    boxCorners(hulls, k, stage.settings.explode).map((corner): Spot => {
      const { x, y } = stage.pixelOf(corner, pane);
      return [x, y];
    }),
  );
}
