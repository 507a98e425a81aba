// What a person does with results: apply, accept, call wrong, exclude, correct, export, and go to the next that wants a look.
import { callFor } from "../store/calls";
import { startDraft } from "../store/draft";
import { perform } from "../store/edits";
import { applyTo, checkAll, whyNotApply, whyNotCheck } from "../store/jobs";
import { useProject } from "../store/project";
import { getVerdict, isWritten, listOutdated, nextInQueue, reviewQueue } from "../store/reviews";
import { notify } from "../store/toasts";
import { countText } from "../store/words";
import { openAsset, openStage, setChecks, useWorkspace, visit } from "../store/workspace";
import type { Card, GoalResultView } from "../wire";
import { commandsOf, inStage, needs, unless } from "./command";
import { runInTurn } from "./queue";

/** All cards in the family's order. */
function cardsInOrder(): Card[] {
  const { order, cards } = useProject.getState();
  return order.flatMap((asset) => cards[asset] ?? []);
}

/** Accepts an output and goes on to the next that wants a look. */
export async function accept(asset: string): Promise<void> {
  const next = nextOf(asset);
  const done = await perform({ kind: "review", ids: [asset], verdict: "accepted", goals: goalsOf(asset, (goal) => goal.accepted) });
  if (done && next && useWorkspace.getState().asset === asset) openAsset(next);
}

/** Texts of some goals of an asset. */
const goalsOf = (asset: string, which: (goal: GoalResultView) => boolean): string[] =>
  useProject.getState().cards[asset]?.goals.filter(which).map(({ goal }) => goal) ?? [];

/** Accepts a result though goals fail on it. */
export const acceptGoals = (asset: string): Promise<boolean> =>
  perform({ kind: "review", ids: [asset], verdict: "accepted", goals: goalsOf(asset, (goal) => goal.accepted || goal.fails) });

export const callWrong = (asset: string, note: string | null): Promise<boolean> =>
  perform({ kind: "review", ids: [asset], verdict: "wrong", note });

/** Keeps a note with a result that was called wrong. */
export const noteWrong = (asset: string, note: string | null): Promise<boolean> =>
  perform({ kind: "review", ids: [asset], verdict: "wrong", note }, { quiet: true });

/** Gives an asset up, or includes it again. */
export const exclude = (asset: string, reason: Card["excluded"]): Promise<boolean> => perform({ kind: "exclude", ids: [asset], reason });

export const withdrawReview = (asset: string): Promise<boolean> =>
  perform({ kind: "review", ids: [asset], verdict: null });

/** Accepts the outputs of some assets that are legal; reports how many are not. */
export async function acceptLegal(assets: readonly string[], progress: (done: number, total: number) => void): Promise<void> {
  const { cards } = useProject.getState();
  const open = assets.flatMap((asset) => cards[asset] ?? []);
  let done = 0;
  progress(0, open.length);
  const verdicts = open.map(async (card) => {
    const found = await getVerdict(card);
    progress(++done, open.length);
    return found === "illegal" ? [] : [card.asset];
  });
  const ids = (await Promise.all(verdicts)).flat();
  const left = open.length - ids.length;
  if (ids.length) await perform({ kind: "review", ids, verdict: "accepted" });
  if (left) notify(`${left} not accepted: ${left === 1 ? "it is" : "they are"} not legal`);
}

/** Shows what the program and the edits by hand make of an asset now, which is what a next edit by hand is about. */
export function showPresent(asset: string): void {
  const { showing, selection } = useWorkspace.getState();
  visit(asset, { kind: "result", of: "program" }, showing.kind === "result" ? selection : []);
}

/** Begins an action that fixes the result of an asset. */
export function startCorrection(asset: string): void {
  showPresent(asset);
  runInTurn(() => startDraft("Delete"));
}

export const dropCorrections = (asset: string): Promise<boolean> => perform({ kind: "drop-manual-edits", asset });

const queue = (): readonly string[] => reviewQueue(cardsInOrder(), useProject.getState().confidence);

function nextOf(asset: string | null): string | null {
  return nextInQueue(queue(), useProject.getState().order, asset);
}

/** Opens the next asset that failed, is wrong or flagged, or was not reviewed yet. */
export function nextToReview(): void {
  const { asset } = useWorkspace.getState();
  const next = nextOf(asset);
  if (next) return openAsset(next);
  const last = asset !== null && queue().includes(asset);
  const old = listOutdated(cardsInOrder()).length;
  const rest = old ? `; ${countText(old, "output")} ${old === 1 ? "is" : "are"} not up to date.` : ".";
  notify(`${last ? "No other result needs review" : old ? "No other result is left to review" : "Nothing is left to review"}${rest}`);
}

const whyNotReview = () => (reviewable() ? null : "Open an asset with a result, in Review (Alt+4).");

/** The card of the open asset, if it has an output that can be reviewed. */
function reviewable(): Card | null {
  const { asset, stage } = useWorkspace.getState();
  const card = useProject.getState().cards[asset ?? ""];
  return stage === "review" && card && isWritten(card) ? card : null;
}

export const reviewCommands = commandsOf("Review", [
  {
    id: "accept",
    title: "Accept the result, go to the next",
    keys: ["Y"],
    enabled: unless(() => whyNotReview() ?? (reviewable()?.stale.length ? "The result is not up to date." : null)),
    run: () => {
      const card = reviewable();
      if (card) return accept(card.asset);
    },
  },
  {
    id: "wrong",
    title: "Call the result wrong, or take that back",
    keys: ["F"],
    enabled: unless(whyNotReview),
    run: () => {
      const card = reviewable();
      if (card) return card.review === "wrong" ? withdrawReview(card.asset) : callWrong(card.asset, card.note);
    },
  },
  {
    id: "apply",
    title: "Apply the program to all assets",
    words: "run batch",
    enabled: unless(whyNotApply),
    run: () => {
      openStage("review");
      void applyTo(null);
    },
  },
  {
    id: "check-all",
    title: "Check all results",
    enabled: unless(whyNotCheck),
    run: () => {
      openStage("review");
      void checkAll();
    },
  },
  {
    id: "checks",
    title: "Show or hide the checks of the result",
    keys: ["Shift+C"],
    enabled: inStage("review"),
    run: () => setChecks({ open: !useWorkspace.getState().checks.open }),
  },
  {
    id: "next-to-review",
    title: "Next result to review",
    keys: ["N"],
    enabled: inStage("review"),
    run: nextToReview,
  },
  {
    id: "export",
    title: "Export results into a folder",
    words: "save output download",
    enabled: needs("Nothing is written yet: apply the program.", () => cardsInOrder().some(isWritten)),
    run: () => {
      openStage("review");
      callFor("export");
    },
    movesFocus: true,
  },
]);
