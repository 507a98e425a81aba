// Commands that look into the asset and measure it: the section plane and the ruler.
import { nearestPoints } from "../store/nearest";
import { addMeasure, clearMeasures, measureExtents, measureGap, useRuler } from "../store/ruler";
import { type Scene, useScenes } from "../store/scenes";
import { setSection, useSection } from "../store/section";
import { setUnit, useWorkspace } from "../store/workspace";
import { commandsOf, needs } from "./command";
import { isHere, toolCommand } from "./view";

const here = (): Scene | null => useScenes.getState().scene;
const isCutOpen = needs("Show the section plane first (Shift+K).", () => useSection.getState().on);
const hasMeasures = needs("Nothing is measured here.", () => useRuler.getState().measures.some(({ asset }) => asset === here()?.asset));

/** Of one hull or several its extents, of two the gap between them. */
export function measureSelection(): void {
  const scene = here();
  const { selection } = useWorkspace.getState();
  if (!scene) return;
  const [a, b, ...more] = scene.hulls.filter((hull) => selection.has(hull.name));
  if (a && b && !more.length) {
    const nearest = nearestPoints(a.shape.positions, b.shape.positions);
    addMeasure(measureGap(scene, [a.name, b.name], [nearest.a, nearest.distance === 0 ? nearest.a : nearest.b]));
    return;
  }
  const extents = measureExtents(scene, selection);
  if (extents) addMeasure(extents);
}

export const measureCommands = commandsOf("View", [
  {
    id: "section",
    title: "Section plane: see inside",
    keys: ["Shift+K"],
    enabled: isHere,
    run: () => setSection({ on: !isCutOpen() }),
  },
  {
    id: "section-flip",
    title: "Flip the section plane",
    enabled: isCutOpen,
    run: () => setSection({ flipped: !useSection.getState().flipped }),
  },
  { ...toolCommand("ruler", "Ruler: measure between two points", ["D"]), group: "View", words: "distance length" },
  {
    id: "measure-selection",
    title: "Measure the selection: the gap between two hulls, or extents",
    keys: ["Shift+D"],
    enabled: needs("Select hulls first.", () => isHere() && useWorkspace.getState().selection.size > 0),
    run: measureSelection,
  },
  {
    id: "clear-measures",
    title: "Clear all measures",
    enabled: hasMeasures,
    run: () => clearMeasures(here()?.asset ?? ""),
  },
  {
    id: "unit",
    title: "Lengths in metres or millimetres",
    words: "unit mm settings",
    run: () => setUnit(useWorkspace.getState().unit === "m" ? "mm" : "m"),
  },
]);
