// An action taken into the hand: a new one, or the step of an asset.
import type { AssetView } from "../wire";
import { type Draft, openStage, select, setDraft, setTool, show, useDesk } from "./desk";
import { parsedAction, placeFor, usualArguments } from "./drafts";
import { formOf, language } from "./language";
import { useProject } from "./project";
import { details } from "./scenes";
import { actionOf } from "./steps";
import { complainedOf } from "./toasts";

/** Begins an action: as the first open rule of that kind does it elsewhere, or with usual arguments. */
export async function startDraft(action: string): Promise<void> {
  const { asset, stage } = useDesk.getState();
  if (asset === null) return;
  if (stage === "label" || stage === "learn") openStage("demonstrate");
  try {
    const [{ actions }, { view }] = await Promise.all([language(), details(asset)]);
    if (useDesk.getState().asset !== asset) return;
    const { rules, templates } = useProject.getState().project;
    const place = stage === "review" ? null : (changed(view) ?? placeFor(action, rules, view, actions));
    const form = formOf(action, actions);
    const parts = place === null ? null : parsedAction(actionOf(place), actions);
    const usual = { action, arguments: form ? usualArguments(form, templates) : {}, each: false, label: "" };
    hold({ ...usual, ...(parts?.action === action ? parts : {}), editing: place });
    if (stage !== "review") showBefore(place ?? view.steps.length, view);
  } catch (error) {
    complainedOf(error);
  }
}

/** The place of a step that is in the hand to be changed; it stays that one with another action. */
function changed({ steps }: AssetView): number | null {
  const place = useDesk.getState().draft?.editing ?? null;
  return place !== null && steps[place]?.select != null ? place : null;
}

/** Takes the step in a place (from 0) into the hand, with these hulls, or with those that it has. */
export async function draftStep(place: number, hulls?: readonly string[]): Promise<void> {
  const { asset } = useDesk.getState();
  if (asset === null) return;
  try {
    const [{ actions }, { view }] = await Promise.all([language(), details(asset)]);
    if (useDesk.getState().asset !== asset) return;
    const step = view.steps[place];
    const parts = parsedAction(step?.action ?? actionOf(place), actions);
    if (!parts) return;
    openStage("demonstrate");
    hold({ ...parts, editing: place });
    showBefore(place, view);
    select(hulls ?? step?.select ?? []);
  } catch (error) {
    complainedOf(error);
  }
}

/** Shows the asset with the steps before a place; where there are more, it stays so while they change. */
export function showBefore(place: number, view: AssetView): void {
  const { showing } = useDesk.getState();
  const steps = Math.min(place, view.steps.length);
  const before = { kind: "steps", steps } as const;
  useDesk.setState({ asked: steps < view.steps.length ? before : null });
  if (showing.kind !== "steps" || showing.steps !== steps) show(before);
}

function hold(draft: Draft): void {
  setTool("select");
  setDraft(draft);
}
