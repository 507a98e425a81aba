// Replies to the question of the family's assessment, each an edit that undo takes back, and the way to its card.
import { create } from "zustand";
import { type Exceptions, isAsked } from "../store/assessment";
import { perform } from "../store/edits";
import { makeResult } from "../store/jobs";
import { useProject } from "../store/project";
import { isUpToDate } from "../store/reviews";
import { openStage, setFilters, setHighlight, setLayout, useWorkspace, visit } from "../store/workspace";
import type { AnyEdit, DoubtView, ReviewQuestionView } from "../wire";
import type { Command } from "./command";
import { flag } from "./review";

/** The question that was replied to last. */
let replied: ReviewQuestionView | null = null;

/** Takes one of a question's choices, counted from 0, or none of them. */
export async function reply(question: ReviewQuestionView, place: number | null): Promise<void> {
  if (question === replied) return; // a second click, before another question is there
  replied = question;
  setHighlight(null);
  const edits = editsFor(question, place);
  for (const edit of edits) {
    if (await perform(edit)) continue;
    replied = null;
    return;
  }
}

/** Asks another question; this one does not come back as long as what it is about stays. */
export function putOff({ id }: ReviewQuestionView): Promise<boolean> {
  setHighlight(null);
  return perform({ kind: "put-off", id });
}

/** The edits that a reply to a question amounts to; none of the choices puts most questions off. */
export function editsFor(question: ReviewQuestionView, place: number | null): AnyEdit[] {
  const { id, kind, rule, asset, hulls, was, choices } = question;
  const choice = place === null ? undefined : choices[place];
  const later: AnyEdit = { kind: "put-off", id };
  switch (kind) {
    case "reading":
    case "label": {
      const refused = choice ? [] : choices.map((one) => one.select ?? []);
      return [{ kind: "answer", rule: rule ?? 1, asset, select: choice?.select ?? null, refused }];
    }
    case "group":
      return choice?.label ? [{ kind: "label-group", hulls: hulls.map(({ asset, hull }) => ({ asset, hull })), label: choice.label }] : [later];
    case "repair": {
      const [first] = hulls;
      const to = choices[0]?.label;
      if (!first || !to || !choice) return [later];
      return [{ kind: "repair", asset: first.asset, hull: first.hull, was, to, accept: choice.label === to }];
    }
    case "selection":
      return place === 0 && choice?.select ? [{ kind: "correct-selection", asset, rule: rule ?? 1, select: choice.select }] : [later];
    case "orientation":
      return choice?.orient ? [{ kind: "orient", text: choice.orient }, later] : [later];
    case "result":
      return choice?.text === "right" ? [{ kind: "review", ids: [asset], verdict: "accepted" }] : [later];
    case "span": {
      const [hull] = hulls;
      if (!hull || place === null) return [later];
      return [{ kind: place === 0 ? "split-span" : "one-part", asset: hull.asset, hull: hull.hull }];
    }
    case "demonstrate":
    default: // also of a kind that this page does not know, where the server is newer
      return [later];
  }
}

/** Labels a group: those of some assets otherwise, or not at all. */
export function labelGroup({ hulls }: ReviewQuestionView, label: string, exceptions: Exceptions): Promise<boolean> {
  setHighlight(null);
  const kept = hulls.filter(({ asset }) => !(asset in exceptions) || exceptions[asset] !== null);
  const rows = kept.map(({ asset, hull }) => ({ asset, hull, label: exceptions[asset] ?? null }));
  return perform({ kind: "label-group", hulls: rows, label });
}

/** Accepts the result of an asset; one that is not there as it would be now is made first. */
export async function acceptResult(asset: string): Promise<boolean> {
  const made = isUpToDate(useProject.getState().cards[asset]) || (await makeResult(asset));
  return made && perform({ kind: "review", ids: [asset], verdict: "accepted" });
}

export const setAside = (asset: string): Promise<boolean> => flag(asset, "set aside");

/** Whether a question is about a result; where the program cannot run there is none that could be right. */
export const canBeRight = ({ kind, choices }: ReviewQuestionView): boolean =>
  kind === "result" && choices.some(({ text }) => text === "right");

/** Opens what a question is about. */
export function showAsked(question: ReviewQuestionView): void {
  const { asset, hulls } = question;
  const names = hulls.filter((one) => one.asset === asset).map((one) => one.hull);
  visit(asset, canBeRight(question) ? { kind: "result", of: "program" } : { kind: "source" }, names);
}

/** Opens an asset with the hulls of a doubt selected. */
export const showDoubt = (asset: string, doubt: DoubtView): void => visit(asset, { kind: "source" }, doubt.hulls);

/** Shows the held assets alone, the least probable first. */
export function lookAtHeld(): void {
  setLayout({ family: true });
  setFilters({ search: "", only: ["held"], sort: "probability", chosen: true });
}

/** Counts how often the card was called for, and up to which call it came. */
export const useCardCalls = create<{ count: number; taken: number }>()(() => ({ count: 0, taken: 0 }));

/** Whether the card was called for since this was asked last; so a stage that a call opens knows of it, too. */
export function takeCall(): boolean {
  const { count, taken } = useCardCalls.getState();
  if (count !== taken) useCardCalls.setState({ taken: count });
  return count !== taken;
}

/** Opens the stage of the card, and gives it the focus. */
export function goToCard(): void {
  const { stage } = useWorkspace.getState();
  if (stage !== "learn" && stage !== "review") openStage("learn");
  useCardCalls.setState(({ count }) => ({ count: count + 1 }));
}

export const questionCommands: readonly Command[] = [
  {
    id: "question",
    title: "Go to the question: 1 to 9 choose, Y accept, N reject, L later, S show",
    group: "Learn",
    keys: ["U"],
    enabled: () => isAsked(useProject.getState()),
    run: goToCard,
    movesFocus: true,
  },
];
