// Commands that look: from standard sides, at all or at the selection, in another manner, with a tool.
import { perform } from "../store/edits";
import { useProject } from "../store/project";
import { useScenes } from "../store/scenes";
import { dismissToast, lastProblem, notify } from "../store/toasts";
import { lookFrom, setTool, setView, type StandardView, type Tool, useWorkspace, type ViewSettings } from "../store/workspace";
import { type Command, commandsOf, type Condition, needs } from "./command";

export const isHere = needs("No asset is shown.", () => useScenes.getState().scene !== null);
const isNotLabelling = needs("In Label, digits give labels.", () => isHere() && useWorkspace.getState().stage !== "label");

const SIDES: readonly { side: StandardView; digit: 1 | 3 | 7; opposite: StandardView }[] = [
  { side: "front", digit: 1, opposite: "back" },
  { side: "right", digit: 3, opposite: "left" },
  { side: "top", digit: 7, opposite: "bottom" },
];

const sideCommands: readonly Command[] = SIDES.flatMap(({ side, digit, opposite }): Command[] => [
  lookCommand(side, [`Numpad${digit}`], isHere),
  lookCommand(opposite, [`Ctrl+Numpad${digit}`], isHere),
  {
    ...lookCommand(side, [String(digit)], isNotLabelling),
    id: `view-${side}-digit`,
    title: `View from the ${side}, by digit`,
    run: () => lookByDigit(side, digit),
  },
]);

let isSaid = false;

/** Looks from a side; says once that a digit gives labels elsewhere, as one may have meant that. */
function lookByDigit(side: StandardView, digit: number): void {
  lookFrom(side);
  if (!isSaid) notify(`View from the ${side}. In the Label stage (Alt+1), ${digit} gives a label.`);
  isSaid = true;
}

function lookCommand(side: StandardView, keys: readonly string[], enabled: Condition): Command {
  const title = `View from the ${side}`;
  return { id: `view-${side}`, title, group: "View", keys, enabled, run: () => lookFrom(side) };
}

type Switch = "ghost" | "wireframe" | "contacts" | "grid" | "opaque";

function toggleCommand(what: Switch, title: string, keys: readonly string[]): Command {
  const flip = (view: ViewSettings): Partial<ViewSettings> => ({ [what]: !view[what] });
  return { id: `toggle-${what}`, title, group: "View", keys, run: () => setView(flip(useWorkspace.getState().view)) };
}

export function toolCommand(name: Tool, title: string, keys: readonly string[]): Command {
  const run = () => setTool(useWorkspace.getState().tool === name ? "select" : name);
  return { id: `tool-${name}`, title, group: "Select", keys, enabled: isHere, run };
}

/** Whether there is an edited asset in sight to compare with the original asset. */
const canCompare = needs("No result or step is shown.", () => useScenes.getState().scene?.edit != null);

function compareCommand(how: "slider" | "side", title: string): Command {
  const run = () => setView({ compare: useWorkspace.getState().view.compare === how ? "off" : how });
  return { id: `compare-${how}`, title, group: "View", keys: [], enabled: canCompare, run };
}

function switchProjection(): void {
  const { projection } = useWorkspace.getState().view;
  setView({ projection: projection === "perspective" ? "orthographic" : "perspective" });
}

export const viewCommands = commandsOf("View", [
  toolCommand("box", "Select by a box", ["B"]),
  toolCommand("lasso", "Select by a lasso", ["L"]),
  {
    id: "tool-leave",
    title: "Leave the tool",
    group: "Select",
    keys: ["Escape"],
    enabled: needs("No tool is in hand.", () => useWorkspace.getState().tool !== "select"),
    run: () => setTool("select"),
  },
  {
    id: "close-problem",
    title: "Close the message of what went wrong",
    keys: ["Escape"],
    enabled: needs("No message is shown.", () => lastProblem() !== undefined),
    run: () => dismissToast(lastProblem()?.id ?? 0),
  },
  ...sideCommands,
  lookCommand("iso", ["Numpad0"], isHere),
  { id: "fit", title: "Fit all into the view", keys: ["Home"], enabled: isHere, run: () => lookFrom("fit") },
  { id: "frame", title: "Frame the selection", keys: [".", "NumpadDecimal"], enabled: isHere, run: () => lookFrom("frame") },
  { id: "projection", title: "Perspective or parallel projection", keys: ["O"], enabled: needs("Assets side by side are always in parallel projection.", () => !useWorkspace.getState().sheet.length), run: switchProjection },
  toggleCommand("wireframe", "Wireframe", ["Z"]),
  toggleCommand("ghost", "Visual mesh as a ghost", ["V"]),
  toggleCommand("contacts", "Contact graph", ["C"]),
  toggleCommand("opaque", "Non-convex pieces", []),
  toggleCommand("grid", "Grid and axes", []),
  ...(["Y", "Z"] as const).map((up) => ({
    id: `up-${up}`,
    title: `${up} points up in files that do not say`,
    enabled: needs(`${up} points up already.`, () => useProject.getState().project.up !== up),
    run: () => perform({ kind: "up", up }),
  })),
  compareCommand("slider", "Compare before and after with a line"),
  compareCommand("side", "Compare before and after side by side"),
]);
