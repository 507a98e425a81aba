// What the server says of the project, kept as it comes; knows neither DOM nor three.js.
import { create } from "zustand";
import { page } from "../server/http";
import { ownPartsOf } from "./commonParts";
import { oncePer } from "./once";
import type { Card, ConfidenceView, Event, Hello, Reach } from "../wire";

export interface ProjectState extends Omit<Hello, "kind" | "cards" | "reach"> {
  connected: boolean;
  /** Whether a first Hello came. */
  ready: boolean;
  cards: Readonly<Record<string, Card>>;
  /** Ids of all assets, in order. */
  order: readonly string[];
  /** What the present program does on each asset. */
  reach: Readonly<Record<string, Reach>>;
  /** How sure each edit was when that was known last, by which the family stays in order meanwhile. */
  confidence: Readonly<Record<string, ConfidenceView>>;
  /** How often everything was sent anew, and of how many edits of this page. */
  hellos: number;
  own: number;
  /** Counts up for each asset whose details changed, so that what is kept of it is fetched anew. */
  revisions: Readonly<Record<string, number>>;
  shapeRevisions: Readonly<Record<string, number>>;
}

export const emptyProject: ProjectState = {
  connected: false,
  ready: false,
  version: "",
  project: {
    name: "",
    folder: "",
    vocabulary: [],
    orient: { text: "", sentence: "", snap: false, pairs: [] },
    contact: null,
    extremity: null,
    rules: [],
    answers: [],
    templates: [],
    goals: [],
    propagation: null,
    new: null,
    next: { kind: "wait", text: "", asset: null, command: null, note: null },
    problem: null,
    lost: [],
    left_out: [],
    up: "",
    ask_up: null,
  },
  cards: {},
  order: [],
  history: { undo: null, redo: null, undoable: 0, redoable: 0 },
  program: { text: "", version: "", by_hand: false, outdated: false, labels: [], orient_sentence: "", rules: [], error: null },
  outcome: null,
  learning: false,
  reach: {},
  assessment: null,
  assessing: false,
  confidence: {},
  jobs: [],
  tour: false,
  leave: false,
  engines: {},
  merged_files: [],
  merged_by: [],
  language: { actions: [], operators: [], directions: [], goals: [] },
  hellos: 0,
  own: 0,
  revisions: {},
  shapeRevisions: {},
};

export const useProject = create<ProjectState>()(() => emptyProject);

/** The state after an event; the same after one of a kind that this page does not know. */
export function applyEvent(state: ProjectState, event: Event): ProjectState {
  switch (event.kind) {
    case "hello": {
      const { kind, cards, reach, ...rest } = event;
      const order = cards.map((card) => card.asset);
      return {
        ...state,
        ...rest,
        ready: true,
        cards: byAsset(cards),
        order,
        reach: byAsset(reach),
        confidence: byAsset(event.assessment?.assets ?? []),
        hellos: state.hellos + 1,
        // what is kept of an asset may be old after a time without connection
        revisions: increment(state.revisions, order),
        shapeRevisions: increment(state.shapeRevisions, order),
      };
    }
    case "cards": {
      const gone = new Set(event.gone);
      const fresh = event.cards.map((card) => card.asset).filter((asset) => !(asset in state.cards));
      const kept = gone.size ? Object.fromEntries(Object.entries(state.cards).filter(([asset]) => !gone.has(asset))) : state.cards;
      const order = gone.size ? state.order.filter((asset) => !gone.has(asset)) : state.order;
      return {
        ...state,
        cards: { ...kept, ...byAsset(event.cards) },
        order: fresh.length ? [...order, ...fresh].sort() : order,
      };
    }
    case "project":
    case "program": {
      const { kind, ...changed } = event;
      return { ...state, ...changed };
    }
    case "history":
      return { ...state, history: event.history, own: state.own + Number(event.by === page) };
    case "assets": {
      const shapes = event.shapes ? increment(state.shapeRevisions, event.assets) : state.shapeRevisions;
      return { ...state, revisions: increment(state.revisions, event.assets), shapeRevisions: shapes };
    }
    case "outcome":
      return event.learning
        ? { ...state, learning: true }
        : { ...state, learning: false, outcome: event.outcome, reach: event.outcome?.program ? state.reach : {}, confidence: event.outcome ? state.confidence : {} };
    case "reach":
      return { ...state, reach: { ...state.reach, ...byAsset(event.reach) } };
    case "assessment": {
      const confidence = event.assessment ? byAsset(event.assessment.assets) : state.confidence;
      return { ...state, assessment: event.assessment, assessing: event.assessing, confidence };
    }
    case "job":
      return { ...state, jobs: [...state.jobs.filter((job) => job.id !== event.job.id), event.job].slice(-20) };
    case "start":
      return state;
    default: // of a newer server than this page was made for
      event satisfies never;
      return state;
  }
}

export const receive = (event: Event): void => useProject.setState((state) => applyEvent(state, event), true);

type Cards = ProjectState["cards"];

/** Works something out from all cards once, however many ask, until one of the cards is another. */
export const oncePerFamily = <T>(compute: (cards: readonly Card[]) => T): ((cards: Cards) => T) =>
  oncePer((cards) => compute(Object.values(cards)));

/** How many assets could be read. */
export const countReadable = oncePerFamily((cards) => cards.filter((card) => card.hulls !== null).length);

/** What each asset has alone of its name. */
export const useOwnNames = (): ((asset: string) => string) => useProject(({ order }) => ownPartsOf(order));

function byAsset<T extends { asset: string }>(rows: readonly T[]): Record<string, T> {
  return Object.fromEntries(rows.map((row) => [row.asset, row]));
}

function increment(counts: Readonly<Record<string, number>>, keys: readonly string[]): Record<string, number> {
  const out = { ...counts };
  for (const key of keys) out[key] = (out[key] ?? 0) + 1;
  return out;
}
