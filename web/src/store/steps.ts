// The steps of an asset, the changes to them, each one edit, and which steps are no longer offered as guesses.
import { create } from "zustand";
import type { ActionCall, ActionView, AssetView, RuleLine, StepEdit, StepView } from "../wire";
import { callOf, isSameAction } from "./actions";
import { perform } from "./edits";
import { useProject } from "./project";
import { getDetails } from "./scenes";
import type { Draft } from "./workspace";

type Change = (steps: readonly StepEdit[]) => readonly StepEdit[];

/** Changes the steps of an asset as they are on the server now; done once the page knows of it, too. */
async function changeSteps(asset: string, change: Change): Promise<boolean> {
  const { view } = await getDetails(asset);
  return perform({ kind: "steps", asset, version: view.version, steps: [...change(stepTexts(view.steps))] });
}

const stepTexts = (steps: readonly StepView[]): StepEdit[] =>
  steps.map(({ select, action }) => ({ select, action: callOf(action) }));

/** Shows a rule on an asset: in place `at` (from 0), the rules before it left open where nothing is said yet. */
export function withStep(at: number, step: StepEdit): Change {
  return (steps) => {
    const filled = [...steps];
    while (filled.length < at) filled.push({ select: null, action: callOf(actionOf(filled.length)) });
    filled[at] = step;
    return filled;
  };
}

/** What the rule in a place (from 0) does, as other assets show it. */
export function actionOf(place: number): ActionView {
  return useProject.getState().project.rules[place]?.action ?? REMOVAL;
}

/** What a place without any rule begins with. */
const REMOVAL: ActionView = { name: "Delete", arguments: {}, each: false, label: null, text: "Delete", short: "Delete", icon: "delete" };

export const withoutStep =
  (at: number): Change =>
  (steps) =>
    at === steps.length - 1 ? steps.slice(0, at) : steps.map((s, k) => (k === at ? { ...s, select: null } : s));

/** Places (from 0) of the family's rules that an asset says nothing about yet. */
export const openRules = (view: AssetView): number[] => openPlaces(useProject.getState().project.rules, view);

/** Places (from 0) of the family's rules that an asset says nothing about. */
export const openPlaces = (rules: readonly RuleLine[], view: Pick<AssetView, "steps">): number[] =>
  rules.map((_, k) => k).filter((k) => view.steps[k]?.select == null);

/** The place of the first open rule that does such an action; null where there is none. */
export function placeFor(
  action: string,
  rules: readonly RuleLine[],
  view: Pick<AssetView, "steps">,
): number | null {
  return openPlaces(rules, view).find((place) => rules[place]?.action.name === action) ?? null;
}

/** Assets on which the rule that a draft shows does something else, which no program could; none for a new rule. */
export function differsOn(draft: Draft, rules: readonly RuleLine[], asset: string | null): readonly string[] {
  const rule = draft.editing === null ? undefined : rules[draft.editing];
  if (!rule || isSameAction(rule.action, draft)) return [];
  return [...rule.shown, ...rule.nothing].filter((other) => other !== asset);
}

/** The place (from 0) that accepting a draft writes: that of its rule, or a new one after all others. */
export function placeOf(draft: Pick<Draft, "editing">, rules: number, steps: number): number {
  return draft.editing ?? Math.max(rules, steps);
}

/** How much a step takes: `4`, `nothing here` or `open`. */
export function amountText(step: Pick<StepView, "select"> | undefined): string {
  if (step?.select == null) return "open";
  return step.select.length ? `×${step.select.length}` : "nothing here";
}

interface OfferState {
  /** The step that was last sent or cancelled; it is not offered until the asset is another. */
  last: string;
  /** Steps that were left open on purpose; they are not offered. */
  declined: ReadonlySet<string>;
}

/** What an asset says about a rule: the step is sent, and remembered so that it is not offered again. */
export const initialOffers: OfferState = { last: "", declined: new Set() };

export const useOffers = create<OfferState>()(() => initialOffers);

/** Says what a rule selects on an asset: names of hulls, [] for nothing here, null for open. */
export function setStep(
  asset: string,
  place: number,
  hulls: string[] | null,
  action: ActionCall = callOf(actionOf(place)),
): Promise<boolean> {
  skipOffer(asset, place);
  decline(asset, place, hulls === null);
  return changeSteps(asset, withStep(place, { select: hulls, action }));
}

/** Takes the step in a place (from 0) away from an asset. */
export function removeStep(asset: string, place: number): Promise<boolean> {
  decline(asset, place, true);
  return changeSteps(asset, withoutStep(place));
}

/** Does not offer a step until the server says that the asset changed. */
export const skipOffer = (asset: string, place: number): void => useOffers.setState({ last: stateKey(asset, place) });

export const isSkipped = (asset: string, place: number): boolean =>
  useOffers.getState().last === stateKey(asset, place);

export const isDeclined = (asset: string, place: number): boolean =>
  useOffers.getState().declined.has(placeKey(asset, place));

function decline(asset: string, place: number, is: boolean): void {
  const declined = new Set(useOffers.getState().declined);
  if (is) declined.add(placeKey(asset, place));
  else declined.delete(placeKey(asset, place));
  useOffers.setState({ declined });
}

const placeKey = (asset: string, place: number): string => `${asset}\n${place}`;

/** A step of an asset as it is now; another one once the asset changed. */
const stateKey = (asset: string, place: number): string =>
  `${placeKey(asset, place)}\n${useProject.getState().revisions[asset] ?? 0}`;

/** Gives the step in a place (from 0) another action, on each of some assets. */
export async function changeActionOn(assets: readonly string[], place: number, action: ActionCall): Promise<void> {
  for (const asset of assets) {
    const done = await changeSteps(asset, (steps) =>
      steps.map((step, k) => (k === place ? { ...step, action } : step)),
    );
    if (!done) return;
  }
}
