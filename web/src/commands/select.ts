// Commands that select hulls, and put hulls out of sight.
import { type Scene, useScenes } from "../store/scenes";
import {
  type Connected,
  hide,
  invert,
  isolate,
  type Selection,
  showAll,
  withConnected,
  withNeighbours,
  withSame,
} from "../store/selection";
import { selectSimilar } from "../store/similar";
import { select, selectHere, setThrough, useWorkspace } from "../store/workspace";
import { commandsOf, type Condition, inStage, needs } from "./command";

/** The scene that the selection belongs to. */
function here(): Scene | null {
  const { scene } = useScenes.getState();
  return scene && scene.asset === useWorkspace.getState().asset ? scene : null;
}

const hasSelection = needs("Select hulls first.", () => here() !== null && useWorkspace.getState().selection.size > 0);
const hasAny = needs("Select hulls first.", () => useWorkspace.getState().selection.size > 0 || useWorkspace.getState().elsewhere.size > 0);
const hasHulls = needs("No hulls are shown.", () => (here()?.hulls.length ?? 0) > 0);

type Rule = (scene: Connected, selection: Selection) => Set<string>;

/** Selects what a rule makes of the selection, as far as it is in sight. */
function changeSelection(rule: Rule): void {
  const scene = here();
  const { selection, hidden } = useWorkspace.getState();
  if (scene) selectHere([...rule(scene, selection)].filter((name) => !hidden.has(name)));
}

/** Hides all but the selection; where just that is in sight already, shows all again. */
function isolateSelection(): void {
  const scene = here();
  const { selection, hidden } = useWorkspace.getState();
  if (!scene) return;
  if (hidden.size > 0 && hidden.size + selection.size === scene.hulls.length) showAll();
  else isolate(scene, selection);
}

/** The key that switches selecting through; held during a drag, it counts for that drag alone. */
export const THROUGH_KEY = "T";

/** A command that selects what a rule makes of the selection. */
const growCommand = (id: string, title: string, key: string, enabled: Condition, rule: Rule) =>
  ({ id: `select-${id}`, title, keys: [key], enabled, run: () => changeSelection(rule) }) as const;

export const selectCommands = commandsOf("Select", [
  growCommand("all", "Select all hulls", "A", hasHulls, ({ hulls }) => new Set(hulls.map((hull) => hull.name))),
  {
    id: "select-none",
    title: "Select nothing",
    keys: ["Alt+A", "Escape"],
    words: "deselect",
    enabled: needs("Nothing is selected.", hasAny),
    run: () => select([]),
  },
  growCommand("invert", "Invert the selection", "I", hasHulls, invert),
  growCommand("grow", "Grow the selection to touching hulls", "G", hasSelection, withNeighbours),
  growCommand("connected", "Select all connected hulls", "Shift+G", hasSelection, withConnected),
  growCommand("alike", "Select all hulls with the same label", "Shift+L", hasSelection, (scene, selection) => withSame("label", scene, selection)),
  {
    ...growCommand("body", "Select all hulls of the same body", "Shift+B", hasSelection, (scene, selection) => withSame("body", scene, selection)),
    words: "link part",
  },
  {
    id: "select-similar",
    title: "Select hulls that look alike; again for more",
    keys: ["J"],
    enabled: hasSelection,
    run: () => selectSimilar("here"),
  },
  {
    id: "select-similar-everywhere",
    title: "Select hulls that look alike on all assets; again for more",
    keys: ["Shift+J"],
    enabled: inStage("label", hasAny),
    run: () => selectSimilar("everywhere"),
  },
  {
    id: "select-through",
    title: "Select through: also take hulls behind others; hold it during a drag for that drag alone",
    keys: [THROUGH_KEY],
    enabled: hasHulls,
    run: () => setThrough(!useWorkspace.getState().through),
  },
  {
    id: "hide",
    title: "Hide the selection",
    keys: ["H"],
    enabled: hasSelection,
    run: () => hide(useWorkspace.getState().selection),
  },
  {
    id: "isolate",
    title: "Hide all but the selection, or show all again",
    keys: ["Shift+H"],
    enabled: hasSelection,
    run: isolateSelection,
  },
  {
    id: "show-all",
    title: "Show all hulls",
    keys: ["Alt+H"],
    enabled: needs("Nothing is hidden.", () => useWorkspace.getState().hidden.size > 0),
    run: showAll,
  },
]);
