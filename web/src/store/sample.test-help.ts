// A card, and how sure edits are, for tests, which say only what matters to them.
import type { ActionCall, ActionForm, ActionView, Argument, AssessmentView, Card, ConfidenceView, ReviewQuestionView } from "../wire";

export const sampleCard = (change: Partial<Card> = {}): Card => ({
  asset: "a",
  hulls: 4,
  labels: [],
  confidence: [],
  demonstrated: false,
  output: "none",
  after: null,
  after_labels: [],
  stale: [],
  error: null,
  flags: [],
  review: null,
  note: null,
  excluded: null,
  manual_edits: 0,
  sources: 0,
  prepared: [],
  picture: null,
  edited_picture: null,
  check: null,
  faults: null,
  goals: [],
  ...change,
});

export const sampleRow = (change: Partial<ConfidenceView> = {}): ConfidenceView => ({
  asset: "a",
  probability: 0.99,
  reasons: [],
  state: "signed",
  reviewed: false,
  ...change,
});

/** A family of assets a0, a1, ..., of which the first ones are held. */
export function sampleAssessment(count: number, held: number, change: Partial<AssessmentView> = {}): AssessmentView {
  const assets = Array.from({ length: count }, (_, k) =>
    sampleRow(k < held ? { asset: `a${k}`, probability: 0.5, state: "needs review" } : { asset: `a${k}` }),
  );
  return { threshold: 0.95, signed_off: count - held, need_review: held, excluded: 0, unseen: 0, assets, question: null, ...change };
}

export const sampleQuestion = (change: Partial<ReviewQuestionView> = {}): ReviewQuestionView => ({
  id: "group-1",
  kind: "group",
  text: "",
  seconds: 4,
  gain: 1,
  asset: "a0",
  rule: null,
  hulls: [],
  choices: [],
  goals: [],
  ...change,
});

export const sampleAction = (name = "Delete", change: Partial<ActionView> = {}): ActionView => ({
  name,
  arguments: {},
  each: false,
  label: null,
  text: name,
  short: name,
  icon: "shapes",
  ...change,
});

/** What the page sends of an action without arguments. */
export const sampleCall = (name = "Delete"): Required<ActionCall> => ({ name, arguments: {}, each: false, label: null });

export const sampleArgument = (name: string, kind: Argument["kind"], choices: string[] = [], required = true): Argument => ({
  name,
  kind,
  title: name,
  wants: name,
  choices,
  words: {},
  omitted: "usual",
  required,
  usual: choices[0] ?? null,
});

export const sampleForm = (name: string, args: Argument[] = [], change: Partial<ActionForm> = {}): ActionForm => ({
  name,
  title: `${name} the selection`,
  summary: "",
  key: "",
  icon: "shapes",
  usage: name,
  makes: true,
  arguments: args,
  clashes: [],
  ...change,
});
