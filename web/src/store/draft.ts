// The action in hand: begun new or from a step, changed, accepted as a step or as an edit by hand, cancelled.
import { create } from "zustand";
import type { ActionForm, AssetView, Problem } from "../wire";
import { callOf, defaultArguments, formOf, missingArgument, withArgument } from "./actions";
import { perform } from "./edits";
import { useProject } from "./project";
import { getDetails, type Scene, useScenes } from "./scenes";
import { actionOf, differsOn, placeFor, placeOf, setStep, skipOffer } from "./steps";
import { notify, reportProblem } from "./toasts";
import { listText, shortName } from "./words";
import { type Draft, openStage, select, setDraft, setTool, show, useWorkspace } from "./workspace";

interface DraftStatus {
  /** While a step is on its way to the server. */
  sending: boolean;
  /** Why the action in hand cannot be done. */
  problem: Problem | null;
  /** What is shown while an accepted step is not in it yet. */
  landing: Scene | null;
  /** Whether the action in hand acts on each part because its rule does so elsewhere, not because the person said so. */
  givenEach: boolean;
}

export const useDraftStatus = create<DraftStatus>()(() => ({ sending: false, problem: null, landing: null, givenEach: false }));

export function changeDraft(change: Partial<Draft>): void {
  const { draft } = useWorkspace.getState();
  if (change.each !== undefined) useDraftStatus.setState({ givenEach: false });
  if (draft) setDraft({ ...draft, ...change });
}

/** Switches whether each part is acted on separately; the first time it is said, what the rule has given is confirmed. */
export function toggleEach(): void {
  const { draft } = useWorkspace.getState();
  if (!draft) return;
  if (draft.each && useDraftStatus.getState().givenEach) {
    useDraftStatus.setState({ givenEach: false });
    return notify("Each connected part separately, as this rule does elsewhere: press E again to switch it off.");
  }
  changeDraft({ each: !draft.each });
}

/** Changes an argument of the action in hand, if it still is that one. */
export function changeArgument(action: string, name: string, value: string | number | boolean): void {
  const { draft } = useWorkspace.getState();
  const form = findForm(action);
  if (draft?.name === action && form) setDraft({ ...draft, arguments: withArgument(draft.arguments, name, value, form) });
}

/** Puts the action down; the asset is shown with all its steps again. */
export async function dropDraft(): Promise<void> {
  const { asset, draft, stage } = useWorkspace.getState();
  if (draft === null) return;
  if (draft.editing !== null && asset !== null) skipOffer(asset, draft.editing);
  useWorkspace.setState({ draft: null, selection: new Set() });
  if (asset === null || stage !== "demonstrate") return;
  const { view } = await getDetails(asset);
  if (useWorkspace.getState().asset === asset && useWorkspace.getState().draft === null) showBefore(view.steps.length, view);
}

/** Makes the action in hand a step of the asset, or, while reviewing, an edit by hand of its output. */
export async function acceptDraft(): Promise<boolean> {
  const { asset, draft, stage, selection } = useWorkspace.getState();
  const names = selectedHulls();
  if (asset === null || draft === null || useDraftStatus.getState().sending) return false;
  const lacking = findObstacle(draft, names.length);
  if (lacking) {
    reportProblem({ message: lacking, where: null, remedy: null, conflict: false });
    return false;
  }
  const call = callOf(draft);
  const done = await trackSending(async () => {
    if (stage === "review") return perform({ kind: "correct", asset, select: names, action: call });
    const { view } = await getDetails(asset);
    return setStep(asset, placeOf(draft, useProject.getState().project.rules.length, view.steps.length), names, call);
  });
  if (done && useWorkspace.getState().asset === asset) {
    useDraftStatus.setState({ landing: useScenes.getState().scene });
    // a result that is corrected stays in view as the program and the edits by hand make it now
    if (stage !== "review") useWorkspace.setState({ asked: null });
    // what was taken into the hand or selected meanwhile stays
    if (useWorkspace.getState().draft === draft) setDraft(null);
    if (useWorkspace.getState().selection === selection) select([]);
  }
  return done;
}

/** The selected hulls that are in what is shown. */
export function selectedHulls(): string[] {
  const { selection } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  return scene?.hulls.map((hull) => hull.name).filter((name) => selection.has(name)) ?? [];
}

function findForm(name: string): ActionForm | undefined {
  return formOf(name, useProject.getState().language.actions);
}

/** Why an action in hand cannot be kept; null where it can. */
export function findObstacle(draft: Draft, hulls: number): string | null {
  if (!hulls) return "Nothing is selected. Select the hulls for this step, or choose “Nothing here”.";
  const form = findForm(draft.name);
  const argument = form && missingArgument(draft, form);
  if (argument) return `${draft.name} needs ${argument.wants}.`;
  const { asset, stage } = useWorkspace.getState();
  const others = stage === "review" ? [] : differsOn(draft, useProject.getState().project.rules, asset);
  return others.length ? `This rule does something else on ${listText(others.map(shortName), 2)}. Make this a new rule, or change it there, too.` : null;
}

async function trackSending(send: () => Promise<boolean>): Promise<boolean> {
  useDraftStatus.setState({ sending: true });
  try {
    return await send();
  } finally {
    useDraftStatus.setState({ sending: false });
  }
}

/** Begins an action: as the first open rule of that kind does it elsewhere, or with usual arguments. */
export async function startDraft(action: string): Promise<void> {
  const { asset, stage } = useWorkspace.getState();
  if (asset === null) return;
  if (stage === "label" || stage === "learn") openStage("demonstrate");
  const { view } = await getDetails(asset);
  if (useWorkspace.getState().asset !== asset) return;
  const { rules, templates } = useProject.getState().project;
  const place = stage === "review" ? null : (placeInHand(view) ?? placeFor(action, rules, view));
  const form = findForm(action);
  const usual = { name: action, arguments: form ? defaultArguments(form, templates) : {}, each: false, label: null };
  const shown = place === null ? null : callOf(actionOf(place));
  const given = shown?.name === action ? shown : null;
  takeInHand({ ...usual, ...given, editing: place }, given?.each);
  if (stage !== "review") showBefore(place ?? view.steps.length, view);
}

/** The place of the step that is being changed; it stays that one with another action. */
function placeInHand({ steps }: AssetView): number | null {
  const place = useWorkspace.getState().draft?.editing ?? null;
  return place !== null && steps[place]?.select != null ? place : null;
}

/** Begins to change the step in a place (from 0), with these hulls, or with those that it has. */
export async function draftStep(place: number, hulls?: readonly string[]): Promise<void> {
  const { asset } = useWorkspace.getState();
  if (asset === null) return;
  const { view } = await getDetails(asset);
  if (useWorkspace.getState().asset !== asset) return;
  const step = view.steps[place];
  const call = callOf(step?.action ?? actionOf(place));
  if (!findForm(call.name)) return;
  openStage("demonstrate");
  takeInHand({ ...call, editing: place });
  showBefore(place, view);
  select(hulls ?? step?.select ?? []);
}

/** Shows the asset with the steps before a place; where there are more, it stays so while they change. */
function showBefore(place: number, view: AssetView): void {
  const { showing } = useWorkspace.getState();
  const steps = Math.min(place, view.steps.length);
  const before = { kind: "steps", steps } as const;
  useWorkspace.setState({ asked: steps < view.steps.length ? before : null });
  if (showing.kind !== "steps" || showing.steps !== steps) show(before);
}

function takeInHand(draft: Draft, givenEach = false): void {
  setTool("select");
  useDraftStatus.setState({ givenEach });
  setDraft(draft);
}
