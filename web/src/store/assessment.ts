// How sure the edits of the family are, in words, and which question is open; knows neither DOM nor three.js.
import type { AssessmentView, Card, ConfidenceView, ReviewQuestionView } from "../wire";
import { isVoid } from "./goals";
import { groupBy } from "./once";
import type { ProjectState } from "./project";
import { countText } from "./words";

/** A probability as people read it. One below the bar never looks as if it reached it, and none looks certain. */
export function percentText(probability: number, bar = 1): string {
  const exact = 100 * probability;
  const near = Math.round(exact);
  const below = exact < 100 * bar && near >= 100 * bar;
  const shown = Math.min(below ? Math.floor(exact) : near, 99);
  return shown < 1 ? "<1%" : `${shown}%`;
}

/** How sure a label is: `99% sure`; certain is only what a person or a file said. */
export const sureText = (confidence: number): string => `${confidence === 1 ? "100%" : percentText(confidence)} sure`;

/** The bar as it was set: `95%`, `99.99%`. */
export const barText = (bar: number): string => `${Number((100 * bar).toPrecision(6))}%`;

/** The assets that need review by their weightiest reason, as `meshforge review` lists them: the least probable first.
 * reason: empty where there is none; share: the least and the most of their probabilities, as `0% to 45%`. */
export function groupHeld({ assets, threshold: bar }: Pick<AssessmentView, "assets" | "threshold">) {
  const held = assets.filter(({ state }) => state === "needs review");
  held.sort((a, b) => a.probability - b.probability || (a.asset < b.asset ? -1 : 1));
  const groups = groupBy(held, ({ reasons }) => reasons[0]?.text ?? "", (row) => row);
  return [...groups].map(([reason, rows]) => {
    const ends = [rows[0], rows.at(-1)].map((row) => percentText(row?.probability ?? 0, bar));
    return { reason, assets: rows.map(({ asset }) => asset), share: [...new Set(ends)].join(" to ") };
  });
}

/** How many assets are signed off: sure ones on which no goal is open, and what a person accepted that did not change since. */
export const countSigned = ({ assets }: AssessmentView, cards: Readonly<Record<string, Card>>): number =>
  assets.filter((row) => {
    const { asset, state, reviewed } = row;
    const card = cards[asset];
    return state === "signed" && !(card && (isVoid(card, row) || (!reviewed && card.goals.some((goal) => goal.is_open))));
  }).length;

/** `Signed off 71 of 75`: of all assets, those that were not looked at counted. signed: see `countSigned`. */
export function signedText({ signed_off, assets, unseen }: AssessmentView, signed = signed_off): string {
  const [done, all] = [signed, assets.length + unseen].map((count) => count.toLocaleString("en-GB"));
  return `Signed off ${done} of ${all}`;
}

/** `look at these 4`; null where none needs review. */
export function lookText({ need_review: held }: Pick<AssessmentView, "need_review">): string | null {
  if (!held) return null;
  return held === 1 ? "look at this one" : `look at these ${held.toLocaleString("en-GB")}`;
}

/** `9,600 were not looked at`, as there are too many, or they cannot be read; null where there are none. */
export function unseenText({ unseen }: Pick<AssessmentView, "unseen">): string | null {
  return unseen ? `${unseen.toLocaleString("en-GB")} ${unseen === 1 ? "was" : "were"} not looked at` : null;
}

/** What of the family is not signed off, as a sentence; null where all is. goals: which are open, in words. */
export function leftText(assessment: AssessmentView, goals: string | null = null): string | null {
  const { need_review: held, excluded, threshold: bar } = assessment;
  const parts = [
    held > 0 && `${held.toLocaleString("en-GB")} ${held === 1 ? "is" : "are"} less than ${barText(bar)} sure: ${lookText(assessment)}`,
    excluded > 0 && `${excluded.toLocaleString("en-GB")} ${excluded === 1 ? "is" : "are"} excluded`,
    unseenText(assessment),
    goals,
  ].filter(Boolean);
  return parts.length ? `${parts.join("; ")}.` : null;
}

/** Good only where nothing needs review, all were looked at, and no goal is open; goals: which are, in words. */
export const moodOf = ({ need_review: held, unseen }: Pick<AssessmentView, "need_review" | "unseen">, goals: string | null = null): "good" | "warn" =>
  held || unseen || goals ? "warn" : "good";

/** What a card says of an asset: a percentage, `…` while it is not known, null where there is no program. */
export function probabilityText(state: Sureness, asset: string): string | null {
  const row = state.confidence[asset];
  if (state.assessment) return row ? percentText(row.probability, state.assessment.threshold) : null;
  return row || isJudging(state) ? "…" : null;
}

type Judging = Pick<ProjectState, "assessing" | "learning" | "outcome">;
type Sureness = Judging & Pick<ProjectState, "assessment" | "confidence">;

/** Whether it is being worked out how sure edits are; while there is no program, only what to ask is. */
export const isJudging = ({ assessing, learning, outcome }: Judging): boolean => assessing && (learning || outcome?.program != null);

/** An asset and why its edit may be wrong, a sentence a line. */
export function doubtsText(asset: string, row: ConfidenceView | undefined, bar: number | null): string {
  if (!row || bar === null) return asset;
  const sure = row.reviewed ? "you showed or accepted it" : `${percentText(row.probability, bar)} sure`;
  return [`${asset}: ${sure}`, ...row.reasons.map((doubt) => `• ${doubt.text}`)].join("\n");
}

/** Kinds of questions that are asked while there is no program. */
const FIRST: readonly ReviewQuestionView["kind"][] = ["repair", "orientation"];

/** The question of the assessment; null where there is none. */
export function openQuestion({ assessment }: Pick<ProjectState, "assessment">): ReviewQuestionView | null {
  const question = assessment?.question ?? null;
  return question && (assessment?.assets.length || FIRST.includes(question.kind)) ? question : null;
}

/** Hulls of a group, by their keys, that get another label than the others, or, with null, none. */
export type Exceptions = Readonly<Record<string, string | null>>;
export type HullInQuestion = Pick<ReviewQuestionView["hulls"][number], "asset" | "hull">;
export const keyOf = ({ asset, hull }: HullInQuestion): string => `${asset}#${hull}`;

/** The label that a hull of a group gets; null where it is left out. */
export function exceptionOf(one: HullInQuestion, exceptions: Exceptions, label: string | null = null): string | null {
  const given = exceptions[keyOf(one)];
  return given === undefined ? label : given;
}

/** Positions of the hulls in question, by asset. */
export const placesOf = ({ hulls }: Pick<ReviewQuestionView, "hulls">): Readonly<Record<string, readonly number[]>> =>
  Object.fromEntries(groupBy(hulls, ({ asset }) => asset, ({ place }) => place));

/** What an answer is worth; null where that is little. */
export function worthText({ gain }: Pick<ReviewQuestionView, "gain">): string | null {
  return gain >= 0.75 ? `An answer probably makes ${countText(Math.round(gain), "more result")} right.` : null;
}
