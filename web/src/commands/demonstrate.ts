// Commands that demonstrate: actions are begun, accepted and cancelled; steps are removed; hulls are cut.
import { acceptDraft, dropDraft, selectedHulls, startDraft, toggleEach } from "../store/draft";
import { acceptGuess, guessFor } from "../store/guesses";
import { useProject } from "../store/project";
import { useScenes } from "../store/scenes";
import { openRules, removeStep } from "../store/steps";
import { setTool, show, useWorkspace } from "../store/workspace";
import { type Command, commandsOf, inStage, needs } from "./command";

const hasAsset = needs("No asset is open.", () => useWorkspace.getState().asset !== null);
const isHere = inStage("demonstrate", hasAsset);
const hasDraft = needs("No action is begun.", () => useWorkspace.getState().draft !== null);

/** Whether actions can be begun: while demonstrating, and on the result that is reviewed. */
const canDraft = needs("Open Demonstrate first (Alt+2), or a result in Review.", () => {
  const { asset, stage, showing } = useWorkspace.getState();
  return asset !== null && (stage === "demonstrate" || (stage === "review" && showing.kind === "result"));
});

/** Commands that begin the actions, each by its own key. */
export function listActionCommands(): readonly Command[] {
  return useProject.getState().language.actions.map(({ name, title, key }) => ({
    id: `draft-${name.toLowerCase()}`,
    title,
    group: "Demonstrate",
    keys: key ? [key] : [],
    enabled: canDraft,
    run: () => startDraft(name),
  }));
}

/** The rule (from 1) whose guess Enter takes: the first that the asset says nothing about. */
function offeredRule(): number | null {
  const { scene } = useScenes.getState();
  if (!scene || scene.asset !== useWorkspace.getState().asset) return null;
  const place = openRules(scene.view)[0];
  return place !== undefined && guessFor(place + 1) ? place + 1 : null;
}

async function acceptStep(): Promise<void> {
  const rule = offeredRule();
  if (useWorkspace.getState().draft) await acceptDraft();
  else if (rule !== null) await acceptGuess(rule);
}

/** The place (from 0) of the step that is shown last. */
function shownStep(): number | null {
  const { asset, showing } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  if (scene?.asset !== asset || showing.kind !== "steps" || showing.steps === 0) return null;
  return showing.steps - 1;
}

async function removeShownStep(): Promise<void> {
  const { asset } = useWorkspace.getState();
  const place = shownStep();
  if (asset !== null && place !== null) await removeStep(asset, place);
}

export const demonstrateCommands = commandsOf("Demonstrate", [
  {
    id: "draft-each",
    title: "Each connected part separately",
    keys: ["E"],
    enabled: hasDraft,
    run: toggleEach,
  },
  {
    id: "draft-accept",
    title: "Add the step, or accept the guess",
    keys: ["Enter"],
    enabled: needs("No action is begun, and no step is guessed.", () => hasDraft() || (isHere() && offeredRule() !== null)),
    run: acceptStep,
  },
  {
    id: "draft-drop",
    title: "Cancel the action",
    keys: ["Escape"],
    enabled: hasDraft,
    run: () => dropDraft(),
  },
  {
    id: "step-delete",
    title: "Remove the shown step",
    keys: ["Backspace", "Delete"],
    enabled: inStage("demonstrate", needs("No step is shown.", () => !hasDraft() && shownStep() !== null)),
    run: removeShownStep,
  },
  {
    id: "cut",
    title: "Split the selected hull by a plane",
    keys: ["K"],
    words: "cut plane knife divide",
    enabled: inStage("demonstrate", needs("Select one hull first.", () => selectedHulls().length === 1)),
    run: startCut,
  },
  {
    id: "landmark",
    title: "Click the landmarks of the orientation",
    words: "orient up axis turn upright",
    enabled: isHere,
    run: startLandmarks,
  },
]);

/** Cuts are made in the original asset. */
export function startCut(): void {
  show({ kind: "source" });
  setTool("cut");
}

/** Landmarks are hulls of the original asset. */
export function startLandmarks(): void {
  show({ kind: "source" });
  setTool("landmark");
}
