// Replies to the question of the family's assessment, each one edit that undo takes back, and the way to its card.
import { callFor } from "../store/calls";
import { exceptionOf, type Exceptions, openQuestion } from "../store/assessment";
import { perform } from "../store/edits";
import { useProject } from "../store/project";
import { differing } from "../store/readings";
import { openStage, setFilters, setHighlight, setLayout, useWorkspace, visit } from "../store/workspace";
import type { Reason, ReplyToQuestion, ReviewQuestionView } from "../wire";
import { commandsOf, needs } from "./command";

/** What is said to a question; nothing: none of its choices. */
export type Said = Omit<ReplyToQuestion, "kind" | "question">;

/** The question that was replied to last. */
let replied: ReviewQuestionView | null = null;

/** Replies to a question; whether that was done. */
export async function reply(question: ReviewQuestionView, said: Said): Promise<boolean> {
  if (question === replied) return false; // a second click, before another question is there
  replied = question;
  setHighlight(null);
  const done = await perform({ kind: "reply", question, ...said });
  if (!done) replied = null;
  return done;
}

/** Asks another question; this one does not come back as long as what it is about stays. */
export const putOff = (question: ReviewQuestionView): Promise<boolean> => reply(question, { later: true });

/** Leaves hulls of which no choice is right to the person: shows those of the first asset in the label stage, selected. */
export function labelByHand(question: ReviewQuestionView): void {
  const [first] = question.hulls;
  if (first) {
    openStage("label");
    visit(first.asset, { kind: "source" }, question.hulls.filter(({ asset }) => asset === first.asset).map(({ hull }) => hull));
  }
  void reply(question, {});
}

/** What is said of a group by its first label: some hulls are something else, or, with null, left out. */
export function groupReply({ hulls, choices: [first] }: ReviewQuestionView, exceptions: Exceptions): Said {
  const leavesOut = Object.values(exceptions).includes(null);
  const others = hulls.flatMap(({ asset, hull }) => {
    const label = exceptionOf({ asset, hull }, exceptions, leavesOut ? first?.label : null);
    return label ? [{ asset, hull, label }] : [];
  });
  return { choice: leavesOut ? null : (first?.id ?? null), exceptions: others };
}

/** Says of a result that a rule should have selected the hulls that are selected in the view. */
export const correctSelection = (question: ReviewQuestionView, rule: number): Promise<boolean> =>
  reply(question, { choice: "wrong", selections: { [rule]: [...useWorkspace.getState().selection].sort() } });

/** Whether a question is about a result; where the program cannot run there is none that could be right. */
export const canBeRight = ({ kind, choices }: ReviewQuestionView): boolean =>
  kind === "result" && choices.some(({ id }) => id === "right");

/** Opens what a question is about. */
export function showAsked(question: ReviewQuestionView): void {
  const { asset, hulls, choices } = question;
  const own = hulls.filter((one) => one.asset === asset).map((one) => one.hull);
  const names = own.length ? own : differing(choices.flatMap(({ select }) => (select ? [select] : [])));
  visit(asset, canBeRight(question) ? { kind: "result", of: "program" } : { kind: "source" }, names);
}

/** Opens an asset with the hulls of a doubt selected. */
export const showDoubt = (asset: string, doubt: Reason): void => visit(asset, { kind: "source" }, doubt.hulls);

/** Shows the held assets alone, the least probable first. */
export function lookAtHeld(): void {
  setLayout({ family: true });
  setFilters({ search: "", only: ["needs review"], sort: "probability", chosen: true });
}

/** Opens the stage of the card, and gives it the focus. */
export function goToCard(): void {
  const { stage } = useWorkspace.getState();
  if (stage !== "learn" && stage !== "review") openStage("learn");
  callFor("card");
}

export const questionCommands = commandsOf("Learn", [
  {
    id: "question",
    title: "Go to the question: 1 to 9 choose, Y accept, N reject, L later, S show",
    keys: ["U"],
    enabled: needs("Nothing is asked now.", () => openQuestion(useProject.getState()) !== null),
    run: goToCard,
    movesFocus: true,
  },
]);
