// Commands that demonstrate: actions are begun, accepted and put down; steps are taken away; hulls are cut.
import { startDraft } from "../store/beginning";
import { setTool, show, useDesk } from "../store/desk";
import { acceptDraft, changeDraft, chosen, dropDraft } from "../store/drafting";
import { acceptGuess, guessFor } from "../store/guesses";
import { dropStep } from "../store/saying";
import { useScenes } from "../store/scenes";
import { openRules } from "../store/steps";
import { complainedOf } from "../store/toasts";
import type { Command } from "./command";

/** The key that begins each action. */
export const ACTION_KEYS: Readonly<Record<string, string>> = {
  Delete: "X",
  Replace: "R",
  Add: "Shift+A",
  Merge: "M",
  Scale: "S",
};

const isHere = (): boolean => useDesk.getState().stage === "demonstrate" && useDesk.getState().asset !== null;

/** Whether actions can be begun: while demonstrating, and on the result that is reviewed. */
export function canDraft(): boolean {
  const { asset, stage, showing } = useDesk.getState();
  return asset !== null && (stage === "demonstrate" || (stage === "review" && showing.kind === "result"));
}

const actions: readonly Command[] = Object.entries(ACTION_KEYS).map(([action, key]) => ({
  id: `draft-${action.toLowerCase()}`,
  title: action === "Add" ? "Add a template beside the selection" : `${action} the selection`,
  group: "Demonstrate",
  keys: [key],
  enabled: canDraft,
  run: () => startDraft(action),
}));

/** The rule (from 1) whose guess Enter takes: the first that the asset says nothing about. */
export function offeredRule(): number | null {
  const { scene } = useScenes.getState();
  if (!scene || scene.asset !== useDesk.getState().asset) return null;
  const place = openRules(scene.view)[0];
  return place !== undefined && guessFor(place + 1) ? place + 1 : null;
}

async function accept(): Promise<void> {
  const rule = offeredRule();
  if (useDesk.getState().draft) await acceptDraft();
  else if (rule !== null) await acceptGuess(rule).catch(complainedOf);
}

/** The place (from 0) of the step that is shown last. */
export function shownStep(): number | null {
  const { asset, showing } = useDesk.getState();
  const { scene } = useScenes.getState();
  if (scene?.asset !== asset || showing.kind !== "steps" || showing.steps === 0) return null;
  return showing.steps - 1;
}

async function takeStepAway(): Promise<void> {
  const { asset } = useDesk.getState();
  const place = shownStep();
  if (asset !== null && place !== null) await dropStep(asset, place).catch(complainedOf);
}

export const demonstrating: readonly Command[] = [
  ...actions,
  {
    id: "draft-each",
    title: "Each connected part separately",
    group: "Demonstrate",
    keys: ["E"],
    enabled: () => useDesk.getState().draft !== null,
    run: () => changeDraft({ each: !useDesk.getState().draft?.each }),
  },
  {
    id: "draft-accept",
    title: "Add the step, or accept the guess",
    group: "Demonstrate",
    keys: ["Enter"],
    enabled: () => useDesk.getState().draft !== null || (isHere() && offeredRule() !== null),
    run: accept,
  },
  {
    id: "draft-drop",
    title: "Put the action down",
    group: "Demonstrate",
    keys: ["Escape"],
    enabled: () => useDesk.getState().draft !== null,
    run: () => dropDraft().catch(complainedOf),
  },
  {
    id: "step-delete",
    title: "Take the shown step away",
    group: "Demonstrate",
    keys: ["Backspace", "Delete"],
    enabled: () => isHere() && useDesk.getState().draft === null && shownStep() !== null,
    run: takeStepAway,
  },
  {
    id: "cut",
    title: "Split the selected hull by a plane",
    group: "Demonstrate",
    keys: ["K"],
    enabled: () => isHere() && chosen().length === 1,
    run: startCut,
  },
  {
    id: "landmark",
    title: "Click the landmarks of the orientation",
    group: "Demonstrate",
    keys: [],
    enabled: isHere,
    run: startLandmarks,
  },
];

/** Cuts are made in the asset as it comes. */
export function startCut(): void {
  show({ kind: "source" });
  setTool("cut");
}

/** Landmarks are hulls of the asset as it comes. */
export function startLandmarks(): void {
  show({ kind: "source" });
  setTool("landmark");
}
