// Box and lasso: they take each hull that is seen inside, and each that is inside as a whole even if it is covered.
import { selectMore, setTool, useDesk } from "../../store/desk";
import type { Side } from "../drawing/side";
import { boxRegion, isInside, type Region, seenIn, type Spot } from "../picking/region";
import { seenPlaces } from "../picking/seen";
import type { Pane } from "../stage/panes";
import { point, pointNowhere, usePointing } from "../stage/pointing";
import type { Stage } from "../stage/stage";
import type { Drag } from "./gestures";

/** Begins a region; with shift it adds, with ctrl it toggles, with Alt it takes away, and the tool stays in hand. */
export function beginRegion(stage: Stage, tool: "box" | "lasso", start: Spot, pressed: PointerEvent): Drag | null {
  const pane = stage.paneAt(start[0]);
  const side = stage.sideOf(pane);
  if (!side) return null;
  const finder = finderOf(stage, side, pane);
  let drawn: Region = [start];
  return {
    move: (spot) => {
      drawn = tool === "box" ? boxRegion(start, spot) : lengthened(drawn, spot);
      point({ drawn, region: finder(drawn) });
    },
    end: (event) => {
      const { region } = usePointing.getState();
      const how = howOf(pressed, event);
      selectMore(region, how);
      pointNowhere();
      if (how === "replace" && useDesk.getState().tool === tool) setTool("select");
    },
    cancel: pointNowhere,
  };
}

const STEP = 3;

function lengthened(drawn: Region, spot: Spot): Region {
  const last = drawn.at(-1) ?? spot;
  return Math.hypot(spot[0] - last[0], spot[1] - last[1]) < STEP ? drawn : [...drawn, spot];
}

function howOf(pressed: PointerEvent, event: PointerEvent): "replace" | "add" | "toggle" | "subtract" {
  const held = (key: "altKey" | "shiftKey" | "ctrlKey" | "metaKey") => pressed[key] || event[key];
  if (held("altKey")) return "subtract";
  if (held("shiftKey")) return "add";
  return held("ctrlKey") || held("metaKey") ? "toggle" : "replace";
}

/** Finds the names of hulls in a region, in the picture as it is now. */
function finderOf(stage: Stage, side: Side, pane: Pane): (region: Region) => ReadonlySet<string> {
  const { hulls } = side;
  const [width, height] = [Math.ceil(pane.width), Math.ceil(stage.height)];
  const places = stage.gl ? seenPlaces(stage.gl, hulls, stage.view.camera(), width, height) : new Uint32Array();
  const spots = vertexSpots(stage, side, pane);
  return (region) => {
    const inPane = region.map(([x, y]): Spot => [x - pane.x, y]);
    const found = seenIn(inPane, places, width, height);
    hulls.names.forEach((_, k) => {
      if (hulls.visible[k] && !found.has(k) && spots[k]?.every((spot) => isInside(region, spot))) found.add(k);
    });
    return new Set([...found].flatMap((k) => hulls.names[k] ?? []));
  };
}

/** Where the corners of each hull's box are seen. */
function vertexSpots(stage: Stage, { hulls }: Side, pane: Pane): Spot[][] {
  const { boxes } = hulls.shapes;
  return hulls.names.map((_, k) => {
    const away = hulls.aways[k] ?? [0, 0, 0];
    const at = (axis: number, high: boolean) =>
      (boxes[6 * k + axis + (high ? 3 : 0)] ?? 0) + stage.settings.explode * (away[axis] ?? 0);
    return Array.from({ length: 8 }, (_corner, c): Spot => {
      const { x, y } = stage.pixelOf([at(0, !!(c & 1)), at(1, !!(c & 2)), at(2, !!(c & 4))], pane);
      return [x, y];
    });
  });
}
