// Commands that select hulls, and put hulls out of sight.
import { select, useDesk } from "../store/desk";
import { hide, isolate, showAll } from "../store/hiding";
import { alike, component, type Connected, grown, inverted, type Selection } from "../store/neighbours";
import { type Scene, useScenes } from "../store/scenes";
import type { Command } from "./command";

/** The scene that the selection belongs to. */
function here(): Scene | null {
  const { scene } = useScenes.getState();
  return scene && scene.asset === useDesk.getState().asset ? scene : null;
}

const some = (): boolean => here() !== null && useDesk.getState().selection.size > 0;
const any = (): boolean => (here()?.hulls.length ?? 0) > 0;

/** Selects what a rule makes of the selection, as far as it is in sight. */
function become(rule: (scene: Connected, selection: Selection) => Set<string>): void {
  const scene = here();
  const { selection, hidden } = useDesk.getState();
  if (scene) select([...rule(scene, selection)].filter((name) => !hidden.has(name)));
}

function isolateSelection(): void {
  const scene = here();
  if (scene) isolate(scene, useDesk.getState().selection);
}

export const selecting: readonly Command[] = [
  {
    id: "select-all",
    title: "Select all hulls",
    group: "Select",
    keys: ["A"],
    enabled: any,
    run: () => become(({ hulls }) => new Set(hulls.map((hull) => hull.name))),
  },
  {
    id: "select-none",
    title: "Select nothing",
    group: "Select",
    keys: ["Alt+A", "Escape"],
    enabled: () => useDesk.getState().selection.size > 0,
    run: () => select([]),
  },
  {
    id: "select-invert",
    title: "Invert the selection",
    group: "Select",
    keys: ["I"],
    enabled: any,
    run: () => become(inverted),
  },
  {
    id: "select-grow",
    title: "Grow to all that touches the selection",
    group: "Select",
    keys: ["G"],
    enabled: some,
    run: () => become(grown),
  },
  {
    id: "select-connected",
    title: "Select all that hangs together with the selection",
    group: "Select",
    keys: ["Shift+G"],
    enabled: some,
    run: () => become(component),
  },
  {
    id: "select-alike",
    title: "Select all hulls with the same label",
    group: "Select",
    keys: ["Shift+L"],
    enabled: some,
    run: () => become(alike),
  },
  {
    id: "hide",
    title: "Hide the selection",
    group: "Select",
    keys: ["H"],
    enabled: some,
    run: () => hide(useDesk.getState().selection),
  },
  {
    id: "isolate",
    title: "Hide all but the selection",
    group: "Select",
    keys: ["Shift+H"],
    enabled: some,
    run: isolateSelection,
  },
  {
    id: "show-all",
    title: "Show all hulls again",
    group: "Select",
    keys: ["Alt+H"],
    enabled: () => useDesk.getState().hidden.size > 0,
    run: showAll,
  },
];
