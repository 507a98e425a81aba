// Goals: how many results each holds on, which are open, and the form of one that is being made or changed.
import { create } from "zustand";
import type { Card, ConfidenceView, GoalCall, GoalResultView, GoalView } from "../wire";
import { type ProjectState, useProject } from "./project";
import { countText } from "./words";

/** Goals that fail on a result, of those in a list of texts if there is one. */
export const failingGoals = (card: Card | undefined, texts?: readonly string[]): readonly GoalResultView[] =>
  card?.excluded ? [] : (card?.goals.filter((goal) => goal.fails && (texts?.includes(goal.goal) ?? true)) ?? []);

/** What stands out of a result: its flags, and goals that fail on it. */
export const flagsOf = (card: Card): readonly string[] => [...card.flags, ...failingGoals(card).map((goal) => `goal ${goal.name} ${goalText(goal)}`)];

/** Whether a goal of an asset fails or was not tried. */
export const hasOpenGoals = ({ goals, excluded }: Card): boolean => !excluded && goals.some((goal) => goal.is_open);

/** Whether a person accepted the result of an asset as it was before something changed, and it is not known that it comes out the
 * same: that says nothing of it now. sure: what is known of it. */
export const isVoid = ({ review, stale }: Pick<Card, "review" | "stale">, sure?: ConfidenceView): boolean =>
  review === "accepted" && !sure?.reviewed && stale.some((reason) => reason !== "software");

/** What is open besides how sure results are: `2 changed since you accepted them; goals fail on 1 result, were not tried on 2`;
 * null where nothing changed, and all goals that apply hold, or are accepted. */
export function openText(state: Pick<ProjectState, "cards"> & Partial<Pick<ProjectState, "confidence">>): string | null {
  const cards = Object.values(state.cards);
  const failing = cards.filter((card) => failingGoals(card).length).length;
  const untried = cards.filter((card) => !card.excluded && card.goals.some(({ outcome }) => outcome === null)).length;
  const changed = cards.filter((card) => !card.excluded && isVoid(card, state.confidence?.[card.asset])).length;
  const goals = [failing && `fail on ${countText(failing, "result")}`, untried && `were not tried on ${untried}`].filter(Boolean);
  const parts = [changed && `${countText(changed, "result")} changed since you accepted ${changed === 1 ? "it" : "them"}`, goals.length && `goals ${goals.join(", ")}`];
  return parts.filter(Boolean).join("; ") || null;
}

/** How many assets a goal holds on, and so on, and those on which it fails. */
export function countGoal(cards: readonly Card[], name: string) {
  const counts = { holds: 0, accepted: 0, away: 0, untried: 0 };
  const fails: string[] = [];
  for (const card of cards) {
    const goal = card.goals.find((one) => one.name === name);
    if (card.excluded) continue;
    if (!goal || goal.outcome === null) counts.untried++;
    else if (goal.fails) fails.push(card.asset);
    else counts[goal.outcome === "untried" ? "away" : goal.accepted ? "accepted" : "holds"]++;
  }
  return { ...counts, fails };
}

/** How a goal stands on a result: `fails: part 1: no grip is free`. */
export function goalText({ outcome, why, accepted }: GoalResultView): string {
  const words = { passed: "holds", failed: "fails", broken: "could not be tried", untried: "does not apply" } as const;
  const text = outcome === null ? "was not tried" : [words[outcome], why].filter(Boolean).join(": ");
  return accepted ? `${text}; accepted all the same` : text;
}

/** The form in hand; name: null where the proposal stands; was: the goal that is changed. */
export type GoalDraft = Readonly<{ call: GoalCall; name: string | null; was: string | null }>;

export const useGoalDraft = create<{ draft: GoalDraft | null }>()(() => ({ draft: null }));

/** Begins to make a goal, or to change one; one that does not parse is made anew under its name. */
export function startGoal(goal?: GoalView): void {
  const [first] = useProject.getState().language.goals;
  const call = goal?.call ?? { name: first?.name ?? "", arguments: {} };
  useGoalDraft.setState({ draft: { call, name: goal?.name ?? null, was: goal?.name ?? null } });
}

export const changeGoal = (change: Partial<GoalDraft>): void =>
  useGoalDraft.setState(({ draft }) => ({ draft: draft && { ...draft, ...change } }));

export const dropGoal = (): void => useGoalDraft.setState({ draft: null });

/** A name that no goal of the project has, but the one that is changed. */
export function freeName(name: string, goals: readonly GoalView[], was: string | null): string {
  const taken = new Set(goals.flatMap((goal) => (goal.name === was ? [] : [goal.name])));
  const names = [name, ...Array.from(taken, (_, k) => `${name}_${k + 2}`)];
  return names.find((one) => !taken.has(one)) ?? name;
}
