// What can be done with a step, as lines of a menu.
import { runInTurn } from "../commands/queue";
import { draftStep, dropDraft } from "../store/draft";
import { perform } from "../store/edits";
import { removeStep, setStep } from "../store/steps";
import { useWorkspace } from "../store/workspace";
import type { MenuLine } from "../ui/Menu";
import type { AssetView } from "../wire";

/** Lines for the rule in a place (from 0) on an asset; rules: how many the family has. */
export function stepMenu(view: AssetView, place: number, rules: number): (MenuLine | "line")[] {
  const { asset } = view;
  const select = view.steps[place]?.select;
  return [
    { label: "Change…", keys: "Enter", leaves: true, onSelect: () => runInTurn(() => draftStep(place)) },
    { label: "Nothing here", disabled: select?.length === 0, onSelect: () => void setStepHere(asset, place, []) },
    { label: "Leave open", disabled: select == null, onSelect: () => void setStepHere(asset, place, null) },
    "line",
    {
      label: "Move earlier on all assets",
      keys: "Alt+←",
      disabled: place === 0,
      onSelect: () => moveRule(place, place - 1),
    },
    {
      label: "Move later on all assets",
      keys: "Alt+→",
      disabled: place >= rules - 1,
      onSelect: () => moveRule(place, place + 1),
    },
    "line",
    { label: "Remove it here", keys: "Del", disabled: select == null, onSelect: () => void removeStep(asset, place) },
    {
      label: "Remove the rule on all assets",
      onSelect: () => void perform({ kind: "delete-rule", rule: place + 1 }),
    },
  ];
}

/** Sets what a rule selects here, in place of the action in hand for it. */
export async function setStepHere(asset: string, place: number, hulls: string[] | null): Promise<void> {
  const done = await setStep(asset, place, hulls);
  if (done && useWorkspace.getState().draft?.editing === place) await dropDraft();
}

/** Rules have one order, in all demonstrations. */
export function moveRule(from: number, to: number): void {
  void perform({ kind: "move-rule", rule: from + 1, to: to + 1 });
}
