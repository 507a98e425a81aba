// Commands that label: the digits, the brush, propagated labels, and the queue of hulls whose label is not sure.
import { propagateLabels, whyNotPropagate } from "../store/jobs";
import { useProject } from "../store/project";
import { useScenes } from "../store/scenes";
import { notify } from "../store/toasts";
import { applyLabel, confirmLabels, goToUnsure, isUnsure } from "../store/unsureHulls";
import { setBrush, useWorkspace } from "../store/workspace";
import { type Command, commandsOf } from "./command";

const isLabelling = (): boolean => useWorkspace.getState().stage === "label";
const labelAt = (place: number): string | undefined => useProject.getState().project.vocabulary[place]?.name;

/** Digits that look from a side in the other stages. */
const SIDE_DIGITS: readonly number[] = [1, 3, 7];

/** Says what a key does in the stage that it is for. */
const sayWhere = (key: string, does: string): void => notify(`${key} ${does} in the Label stage (Alt+1).`);

const digitCommands: readonly Command[] = [1, 2, 3, 4, 5, 6, 7, 8, 9].map((digit) => ({
  id: `label-${digit}`,
  title: `Label ${digit}: label the selection, or paint`,
  group: "Label",
  keys: [String(digit)],
  enabled: () => labelAt(digit - 1) !== undefined && (isLabelling() || !SIDE_DIGITS.includes(digit)),
  run: () => (isLabelling() ? applyLabel(labelAt(digit - 1) ?? null) : sayWhere(String(digit), `gives the label ${labelAt(digit - 1)}`)),
}));

const isUnsureAny = (): boolean =>
  isLabelling() && Object.values(useProject.getState().cards).some((card) => card.unsure.length > 0);

/** Propagates labels, or says why not. */
function tryPropagate(): unknown {
  const why = whyNotPropagate();
  return why === null ? propagateLabels() : notify(why);
}

/** Whether a hull is selected whose label is not sure. */
function isDoubtful(): boolean {
  const { asset, selection } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset) return false;
  const card = useProject.getState().cards[asset];
  return [...selection].some((name) => isUnsure(card, scene.view.hulls, name));
}

export const labelCommands = commandsOf("Label", [
  ...digitCommands,
  {
    id: "label-none",
    title: "No label: remove it from the selection, or by painting",
    keys: ["0"],
    run: () => (isLabelling() ? applyLabel(null) : sayWhere("0", "removes labels")),
  },
  {
    id: "label-right",
    title: "Confirm the labels of the selection; next unsure hull",
    keys: ["Enter"],
    enabled: () => isLabelling() && isDoubtful(),
    run: confirmLabels,
  },
  {
    id: "label-next-unsure",
    title: "Next unsure hull",
    keys: ["N"],
    enabled: isUnsureAny,
    run: () => goToUnsure(),
  },
  {
    id: "label-previous-unsure",
    title: "Previous unsure hull",
    keys: ["Shift+N"],
    enabled: isUnsureAny,
    run: () => goToUnsure(-1),
  },
  {
    id: "label-carry-over",
    title: "Propagate labels to all assets",
    keys: ["P"],
    run: () => (isLabelling() ? tryPropagate() : sayWhere("P", "propagates labels")),
  },
  {
    id: "label-brush-down",
    title: "Stop painting",
    keys: ["Escape"],
    enabled: () => useWorkspace.getState().brush !== null,
    run: () => setBrush(null),
  },
]);
