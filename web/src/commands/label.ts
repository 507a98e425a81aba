// Commands that label: the digits, the brush, all hulls at once, and the walk through labels that nobody gave.
import { GIVEN } from "../store/family";
import { labelAll, saveEdits, whyNotLabel } from "../store/jobs";
import { applyLabel, confirmLabels, walk } from "../store/labelWalk";
import { useProject } from "../store/project";
import { useScenes } from "../store/scenes";
import { notify } from "../store/toasts";
import { openStage, setBrush, useWorkspace } from "../store/workspace";
import { callFor } from "../store/calls";
import { type Command, commandsOf, inStage, needs } from "./command";

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
  enabled: needs(
    () => (labelAt(digit - 1) === undefined ? `There is no label ${digit}.` : "Open Label first (Alt+1)."),
    () => labelAt(digit - 1) !== undefined && (isLabelling() || !SIDE_DIGITS.includes(digit)),
  ),
  run: () => (isLabelling() ? applyLabel(labelAt(digit - 1) ?? null) : sayWhere(String(digit), `gives the label ${labelAt(digit - 1)}`)),
}));

const canWalk = inStage("label", needs("There are no assets yet.", () => useProject.getState().order.length > 0));

/** Labels all hulls, or says why not, as soon as what was painted before is saved. */
export async function tryLabel(): Promise<unknown> {
  await saveEdits();
  const why = whyNotLabel();
  return why === null ? labelAll() : notify(why);
}

/** Whether a hull is selected whose label nobody gave. */
function isDoubtful(): boolean {
  const { asset, selection } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset) return false;
  const confidence = useProject.getState().cards[asset]?.confidence ?? [];
  const sure = new Map(scene.view.hulls.map(({ name }, position) => [name, confidence[position]]));
  return scene.hulls.some(({ name, look }) => selection.has(name) && look && (sure.get(name) ?? GIVEN) !== GIVEN);
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
    title: "Confirm the labels of the selection; next hull",
    keys: ["Enter"],
    words: "confirm accept right",
    enabled: inStage("label", needs("Select a hull with a guessed label.", isDoubtful)),
    run: confirmLabels,
  },
  {
    id: "label-next",
    title: "Next hull whose label nobody gave, the least sure first",
    keys: ["N"],
    enabled: canWalk,
    run: () => walk(),
  },
  {
    id: "label-previous",
    title: "Hull before that one, which is less sure",
    keys: ["Shift+N"],
    enabled: canWalk,
    run: () => walk(-1),
  },
  {
    id: "label-all",
    title: "Label all hulls from files, names and labels",
    words: "propagate guess",
    keys: ["P"],
    run: () => (isLabelling() ? tryLabel() : sayWhere("P", "labels all hulls")),
  },
  {
    id: "vocabulary",
    title: "Add, rename or remove labels",
    words: "vocabulary names list",
    run: () => {
      openStage("label");
      callFor("vocabulary");
    },
    movesFocus: true,
  },
  {
    id: "label-brush-down",
    title: "Stop painting",
    keys: ["Escape"],
    enabled: needs("Nothing is painted.", () => useWorkspace.getState().brush !== null),
    run: () => setBrush(null),
  },
]);
