// The action in hand: begun, changed, accepted as a step or as a correction, put down.
import { create } from "zustand";
import type { AssetView, Problem } from "../wire";
import { type Draft, openStage, select, setDraft, setTool, show, useDesk } from "./desk";
import { formOf, language } from "./language";
import { missingArgument, parsedAction, placeFor, placeOf, usualArguments } from "./drafts";
import { perform } from "./edits";
import { useProject } from "./project";
import { details, type Scene, useScenes } from "./scenes";
import { actionOf, changeSteps, draftText, shown } from "./steps";
import { complained, complainedOf } from "./toasts";

interface DraftingState {
  /** While a step is on its way to the server. */
  sending: boolean;
  /** Why the action in hand cannot be done. */
  problem: Problem | null;
  /** The step that was last sent or put down; it is not offered again until the asset is another. */
  last: string;
  /** What is shown while an accepted step is not in it yet. */
  landing: Scene | null;
}

export const useDrafting = create<DraftingState>()(() => ({ sending: false, problem: null, last: "", landing: null }));

/** Begins an action: as the first open rule of that kind does it elsewhere, or with usual arguments. */
export async function startDraft(action: string): Promise<void> {
  const { asset, stage } = useDesk.getState();
  if (asset === null) return;
  if (stage === "label" || stage === "learn") openStage("demonstrate");
  try {
    const [{ actions }, { view }] = await Promise.all([language(), details(asset)]);
    if (useDesk.getState().asset !== asset) return;
    const { rules, templates } = useProject.getState().project;
    const place = stage === "review" ? null : placeFor(action, rules, view, actions);
    const form = formOf(action, actions);
    const parts = place === null ? null : parsedAction(actionOf(place), actions);
    if (form) hold({ action, arguments: usualArguments(form, templates), each: false, label: "", ...parts, editing: place });
    if (stage !== "review") showBefore(place ?? view.steps.length, view);
  } catch (error) {
    complainedOf(error);
  }
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

export function changeDraft(change: Partial<Draft>): void {
  const { draft } = useDesk.getState();
  if (draft) setDraft({ ...draft, ...change });
}

/** Puts the action down; the asset is shown with all its steps again. */
export async function dropDraft(): Promise<void> {
  const { asset, draft, stage } = useDesk.getState();
  if (draft === null) return;
  if (draft.editing !== null && asset !== null) useDrafting.setState({ last: stepKey(asset, draft.editing) });
  useDesk.setState({ draft: null, selection: new Set() });
  if (asset === null || stage !== "demonstrate") return;
  const { view } = await details(asset);
  if (useDesk.getState().asset === asset && useDesk.getState().draft === null) showBefore(view.steps.length, view);
}

/** The asset with the steps before a place. */
function showBefore(place: number, view: AssetView): void {
  const { showing } = useDesk.getState();
  const steps = Math.min(place, view.steps.length);
  if (showing.kind !== "steps" || showing.steps !== steps) show({ kind: "steps", steps });
}

/** Makes the action in hand a step of the asset, or, while reviewing, an edit by hand of its output. */
export async function acceptDraft(): Promise<boolean> {
  const { asset, draft, stage } = useDesk.getState();
  const names = chosen();
  if (asset === null || draft === null || useDrafting.getState().sending) return false;
  const lacking = await whatIsLacking(draft, names.length);
  if (lacking) {
    complained({ message: lacking, where: null, remedy: null, conflict: false });
    return false;
  }
  const text = await writtenOut(draft);
  const done = await sent(async () => {
    if (stage === "review") return perform({ kind: "correct", asset, select: names, action: text });
    const { view } = await details(asset);
    return sayStep(asset, placeOf(draft, useProject.getState().project.rules.length, view.steps.length), names, text);
  });
  if (done && useDesk.getState().asset === asset) {
    useDrafting.setState({ landing: useScenes.getState().scene });
    // a result that is corrected stays in view as the program and the edits by hand make it now
    useDesk.setState({ draft: null, selection: new Set(), ...(stage === "review" ? {} : { asked: null }) });
  }
  return done;
}

/** Says what a rule selects on an asset: names of hulls, [] for nothing here, null for open. */
export function sayStep(asset: string, place: number, hulls: string[] | null, action = actionOf(place)): Promise<boolean> {
  useDrafting.setState({ last: stepKey(asset, place) });
  return changeSteps(asset, shown(place, { select: hulls, action }));
}

/** A step of an asset as it is now; another once the server says that the asset changed. */
export function stepKey(asset: string, place: number): string {
  return [asset, place, useProject.getState().revisions[asset] ?? 0].join("\n");
}

/** The selected hulls that are in what is shown. */
export function chosen(): string[] {
  const { selection } = useDesk.getState();
  const { scene } = useScenes.getState();
  return scene?.hulls.map((hull) => hull.name).filter((name) => selection.has(name)) ?? [];
}

export async function writtenOut(draft: Draft): Promise<string> {
  const form = formOf(draft.action, (await language()).actions);
  return draftText(draft, form?.arguments ?? []);
}

async function whatIsLacking(draft: Draft, hulls: number): Promise<string | null> {
  if (!hulls) return "Nothing is selected. Select the hulls that the step is about, or say “Nothing here”.";
  const form = formOf(draft.action, (await language()).actions);
  const argument = form && missingArgument(draft, form);
  return argument ? `${draft.action} still needs ${argument.wants}.` : null;
}

function hold(draft: Draft): void {
  setTool("select");
  useDrafting.setState({ problem: null });
  setDraft(draft);
}

async function sent(send: () => Promise<boolean>): Promise<boolean> {
  useDrafting.setState({ sending: true });
  try {
    return await send();
  } catch (error) {
    complainedOf(error);
    return false;
  } finally {
    useDrafting.setState({ sending: false });
  }
}
