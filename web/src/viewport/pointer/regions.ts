// Selecting by a box or a lasso: what is seen in it, or all that lies behind it as well.
import { cornersOf } from "../camera/pose";
import type { AssetDrawing } from "../drawing/assetDrawing";
import { drawHullIds } from "../drawing/hullIds";
import { planeIn } from "../drawing/section";
import { meets, outlineOf } from "../geometry/outline";
import { boxRegion, isInside, placesInside, type Region, type Spot } from "../geometry/region";
import { beyond } from "../geometry/section";
import type { Point } from "../geometry/triangles";
import { clearRegion, setRegion, useRegion } from "../stage/regionStore";
import type { Pane } from "../stage/panes";
import type { Stage } from "../stage/stage";
import { ORIGIN, plus, type Triple } from "../../store/vectors";
import { selectMore, setTool, useWorkspace } from "../../store/workspace";
import type { Drag } from "./gestures";
import { noteDrag } from "./heldKeys";

/** Begins a region; with shift it adds, with ctrl it toggles, with Alt it takes away, and the tool stays in hand. */
export function beginRegion(stage: Stage, tool: "box" | "lasso", start: Spot, pressed: PointerEvent): Drag | null {
  const pane = stage.paneAt(start[0]);
  const side = stage.sideOf(pane);
  if (!side) return null;
  const finder = finderOf(stage, side, pane);
  let drawn: Region = [start];
  const find = (): void => setRegion({ drawn, region: finder(drawn, useWorkspace.getState().through) });
  // a key that is pressed during the drag shows at once what it changes
  const stop = useWorkspace.subscribe((now, before) => {
    if (now.through !== before.through && drawn.length > 1) find();
  });
  const leave = (): void => {
    stop();
    clearRegion();
  };
  return {
    move: (spot) => {
      drawn = tool === "box" ? boxRegion(start, spot) : extendLasso(drawn, spot);
      find();
    },
    end: (event) => {
      const { region } = useRegion.getState();
      const how = selectionMode(pressed, event);
      noteDrag();
      selectMore(region, how);
      leave();
      if (how === "replace" && useWorkspace.getState().tool === tool) setTool("select");
    },
    cancel: leave,
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

type Finder = (region: Region, through: boolean) => ReadonlySet<string>;

/** Finds the names of hulls in a region, in the picture as it is now; through: also those behind others. */
function finderOf(stage: Stage, side: AssetDrawing, pane: Pane): Finder {
  const { hulls } = side;
  const [width, height] = [Math.ceil(pane.width), Math.ceil(stage.height)];
  const places = stage.gl ? drawHullIds(stage.gl, hulls, side.closed.geometry, stage.view.camera(), width, height) : new Uint32Array();
  const spots = vertexSpots(stage, side, pane);
  let outlines: readonly Spot[][] | null = null;
  return (region, through) => {
    outlines ??= through ? outlinesOf(stage, side, pane) : null;
    const inPane = region.map(([x, y]): Spot => [x - pane.x, y]);
    const found = placesInside(inPane, places, width, height);
    hulls.names.forEach((_, k) => {
      if (!hulls.visible[k] || found.has(k) || isCutAway(stage, side, k)) return;
      const inside = through ? meets(region, outlines?.[k] ?? []) : spots[k]?.every((spot) => isInside(region, spot));
      if (inside) found.add(k);
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
  return cornersOf([...shapes.boxes.subarray(6 * k, 6 * k + 6)]).map((corner) => plus(corner, aways[k] ?? ORIGIN, explode));
}

/** Where the corners of each hull's box are seen. */
function vertexSpots(stage: Stage, { hulls }: AssetDrawing, pane: Pane): Spot[][] {
  return hulls.names.map((_, k) => boxCorners(hulls, k, stage.settings.explode).map((corner) => spotOf(stage, corner, pane)));
}

function spotOf(stage: Stage, point: Point, pane: Pane): Spot {
  const { x, y } = stage.pixelOf(point, pane);
  return [x, y];
}

/** The outline of each hull in the picture. */
function outlinesOf(stage: Stage, { hulls, scene }: AssetDrawing, pane: Pane): Spot[][] {
  return scene.hulls.map(({ shape: { positions } }, k) => {
    const corners = Array.from({ length: positions.length / 3 }, (_, v) => [...positions.subarray(3 * v, 3 * v + 3)] as Triple);
    return outlineOf(corners.map((corner) => spotOf(stage, plus(corner, hulls.aways[k] ?? ORIGIN, stage.settings.explode), pane)));
  });
}
