// What can be done with a step, as lines of a menu.
import { inTurn } from "../commands/turns";
import { draftStep } from "../store/beginning";
import { dropDraft } from "../store/drafting";
import { useDesk } from "../store/desk";
import { perform } from "../store/edits";
import { dropStep, sayStep } from "../store/saying";
import { complainedOf } from "../store/toasts";
import type { MenuLine } from "../ui/Menu";
import type { AssetView } from "../wire";

/** Lines for the rule in a place (from 0) on an asset; rules: how many the family has. */
export function stepLines(view: AssetView, place: number, rules: number): (MenuLine | "line")[] {
  const { asset } = view;
  const select = view.steps[place]?.select;
  return [
    { label: "Change it…", keys: "Enter", onSelect: () => inTurn(() => draftStep(place)) },
    { label: "Nothing here", disabled: select?.length === 0, onSelect: () => void say(asset, place, []) },
    { label: "Leave open", disabled: select == null, onSelect: () => void say(asset, place, null) },
    "line",
    {
      label: "Earlier, on all assets",
      keys: "Alt+←",
      disabled: place === 0,
      onSelect: () => moveRule(place, place - 1),
    },
    {
      label: "Later, on all assets",
      keys: "Alt+→",
      disabled: place >= rules - 1,
      onSelect: () => moveRule(place, place + 1),
    },
    "line",
    { label: "Take it away here", keys: "Del", disabled: select == null, onSelect: () => takeAway(asset, place) },
    {
      label: "Take the rule away, on all assets",
      onSelect: () => void perform({ kind: "delete-rule", rule: place + 1 }),
    },
  ];
}

/** Says what a rule does here in place of what is in the hand for it. */
export async function say(asset: string, place: number, hulls: string[] | null): Promise<void> {
  try {
    const done = await sayStep(asset, place, hulls);
    if (done && useDesk.getState().draft?.editing === place) await dropDraft();
  } catch (error) {
    complainedOf(error);
  }
}

/** Rules have one order, in all demonstrations. */
export function moveRule(from: number, to: number): void {
  void perform({ kind: "move-rule", rule: from + 1, to: to + 1 });
}

export function takeAway(asset: string, place: number): void {
  dropStep(asset, place).catch(complainedOf);
}
