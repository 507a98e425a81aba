// The action in hand: changed, accepted as a step or as an edit by hand, put down.
import { create } from "zustand";
import type { Problem } from "../wire";
import { showBefore } from "./beginning";
import { type Draft, select, setDraft, useDesk } from "./desk";
import { missingArgument, placeOf, withArgument } from "./drafts";
import { perform } from "./edits";
import { formOf, language } from "./language";
import { useProject } from "./project";
import { passOver, sayStep } from "./saying";
import { details, type Scene, useScenes } from "./scenes";
import { draftText } from "./steps";
import { complained, complainedOf } from "./toasts";

interface DraftingState {
  /** While a step is on its way to the server. */
  sending: boolean;
  /** Why the action in hand cannot be done. */
  problem: Problem | null;
  /** What is shown while an accepted step is not in it yet. */
  landing: Scene | null;
}

export const useDrafting = create<DraftingState>()(() => ({ sending: false, problem: null, landing: null }));

export function changeDraft(change: Partial<Draft>): void {
  const { draft } = useDesk.getState();
  if (draft) setDraft({ ...draft, ...change });
}

/** Changes an argument of the action in hand, if it still is that one. */
export function changeArgument(action: string, name: string, value: string | number | boolean): void {
  const { draft } = useDesk.getState();
  if (draft?.action === action) setDraft({ ...draft, arguments: withArgument(draft.arguments, name, value) });
}

/** Puts the action down; the asset is shown with all its steps again. */
export async function dropDraft(): Promise<void> {
  const { asset, draft, stage } = useDesk.getState();
  if (draft === null) return;
  if (draft.editing !== null && asset !== null) passOver(asset, draft.editing);
  useDesk.setState({ draft: null, selection: new Set() });
  if (asset === null || stage !== "demonstrate") return;
  const { view } = await details(asset);
  if (useDesk.getState().asset === asset && useDesk.getState().draft === null) showBefore(view.steps.length, view);
}

/** Makes the action in hand a step of the asset, or, while reviewing, an edit by hand of its output. */
export async function acceptDraft(): Promise<boolean> {
  const { asset, draft, stage, selection } = useDesk.getState();
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
    if (stage !== "review") useDesk.setState({ asked: null });
    // what was taken into the hand or selected meanwhile stays
    if (useDesk.getState().draft === draft) setDraft(null);
    if (useDesk.getState().selection === selection) select([]);
  }
  return done;
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
