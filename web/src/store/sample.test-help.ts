// A card, and how sure edits are, for tests, which say only what matters to them.
import type { AssessmentView, Card, ConfidenceView, ReviewQuestionView } from "../wire";

export const sampleCard = (change: Partial<Card> = {}): Card => ({
  asset: "a",
  hulls: 4,
  labels: [],
  unsure: [],
  given: 0,
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
  corrections: 0,
  sources: 0,
  prepared: [],
  picture: null,
  edited_picture: null,
  check: null,
  faults: null,
  ...change,
});

export const sampleRow = (change: Partial<ConfidenceView> = {}): ConfidenceView => ({
  asset: "a",
  probability: 0.99,
  doubts: [],
  state: "signed",
  told: false,
  ...change,
});

/** A family of assets a0, a1, ..., of which the first ones are held. */
export function sampleAssessment(count: number, held: number, change: Partial<AssessmentView> = {}): AssessmentView {
  const assets = Array.from({ length: count }, (_, k) =>
    sampleRow(k < held ? { asset: `a${k}`, probability: 0.5, state: "held" } : { asset: `a${k}` }),
  );
  return { number: 1, bar: 0.95, signed_off: count - held, held, excluded: 0, unseen: 0, assets, question: null, ...change };
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
  ...change,
});
