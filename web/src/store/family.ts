// Which assets the family shows, and in which order.
import type { Card, ConfidenceView, ProjectView } from "../wire";
import { faultsOf, weightOf } from "./checks";
import { flagsOf, isVoid } from "./goals";
import { oncePer } from "./once";
import { oncePerFamily, useProject } from "./project";
import { type FilterName, type Filters, useWorkspace } from "./workspace";

type Cards = Readonly<Record<string, Card>>;
type Confidence = Readonly<Record<string, ConfidenceView>>;

/** The place of the label of a hull that has none; one that is no part has another. */
export const UNLABELLED = -1;

/** In `Card.confidence`, a label that a person, a file or a name gave; one below half is not sure. */
export const GIVEN = 101;
const HALF = 50;
export const isUnsure = (sure: number): boolean => sure !== UNLABELLED && sure < HALF;
export const countUnsure = (card: Card): number => card.confidence.filter(isUnsure).length;

/** How many hulls of an asset have no label. */
export const unlabelled = (card: Card): number => card.labels.filter((label) => label === UNLABELLED).length;

/** Whether no hull of the family has a label. */
export const isBare = oncePerFamily((cards) => !cards.some((card) => card.labels.some((label) => label !== UNLABELLED)));

const MATCHES: Readonly<Record<FilterName, (card: Card, engine: string, sure?: ConfidenceView) => boolean>> = {
  unlabelled: (card) => card.labels.some((label) => label === UNLABELLED),
  unsure: (card) => card.confidence.some(isUnsure),
  demonstrated: (card) => card.demonstrated,
  edited: (card) => card.output === "edited",
  accepted: (card) => card.review === "accepted" && !isVoid(card),
  wrong: (card) => card.review === "wrong",
  flagged: (card) => flagsOf(card).length > 0,
  failed: (card) => card.output === "failed" || card.error !== null,
  stale: (card) => card.output !== "none" && card.stale.length > 0,
  findings: (card, engine) => faultsOf(card, engine).length > 0,
  "needs review": (_card, _engine, sure) => sure?.state === "needs review",
};

export const FILTERS = Object.keys(MATCHES) as readonly FilterName[];

/** engine: whose limits count as findings of checks; sure: how sure its edit is. */
export const matchesFilter = (card: Card, filter: FilterName, engine = "", sure?: ConfidenceView): boolean =>
  MATCHES[filter](card, engine, sure);

/** How many cards each filter would show. */
export function countByFilter(cards: Cards, engine = "", confidence: Confidence = {}): Record<FilterName, number> {
  const counts = Object.fromEntries(FILTERS.map((name) => [name, 0])) as Record<FilterName, number>;
  for (const card of Object.values(cards)) {
    for (const name of FILTERS) counts[name] += Number(MATCHES[name](card, engine, confidence[card.asset]));
  }
  return counts;
}

/** The assets to show: any of the filters that are on, every word of the search, sorted. */
export function filterAssets(
  cards: Cards,
  order: readonly string[],
  filters: Filters,
  project: Pick<ProjectView, "vocabulary">,
  engine = "",
  confidence: Confidence = {},
): readonly string[] {
  const words = filters.search.toLowerCase().split(/\s+/).filter(Boolean);
  const labels = project.vocabulary.map((label) => label.name.toLowerCase());
  const kept = sortByName(order).filter((asset) => {
    const card = cards[asset];
    if (!card) return false;
    const wanted = filters.only.length === 0 || filters.only.some((name) => MATCHES[name](card, engine, confidence[asset]));
    return wanted && words.every((word) => matchesWord(card, word, labels));
  });
  const { sort: by } = filters;
  if (by === "name") return kept;
  const weigh = (asset: string, card = cards[asset]) => (by === "probability" ? -urgency(confidence[asset]) : card ? AMOUNT[by](card, engine) : -1);
  const amounts = new Map(kept.map((asset) => [asset, weigh(asset)]));
  return [...kept].sort((a, b) => (amounts.get(b) ?? 0) - (amounts.get(a) ?? 0));
}

/** Whether a word stands in the id of an asset, or begins a label that one of its hulls has. */
function matchesWord(card: Card, word: string, labels: readonly string[]): boolean {
  if (card.asset.toLowerCase().includes(word)) return true;
  return card.labels.some((label) => labels[label]?.startsWith(word));
}

type Amount = Exclude<Filters["sort"], "name" | "probability">;

const AMOUNT: Readonly<Record<Amount, (card: Card, engine: string) => number>> = {
  hulls: (card) => card.hulls ?? -1,
  unlabelled,
  unsure: countUnsure,
  changed: (card) => (card.after === null || card.hulls === null ? -1 : Math.abs(card.hulls - card.after)),
  findings: (card, engine) => weightOf(card, engine),
};

const byName = new Intl.Collator("en", { numeric: true });

/** The assets by name, numbers in them by their size; a list is sorted once. */
const sortByName = oncePer((order: readonly string[]): readonly string[] => [...order].sort(byName.compare));

/** The least probable first; after them those that are excluded, and those of which nothing is known. */
function urgency(sure: ConfidenceView | undefined): number {
  if (!sure) return 3;
  return sure.state === "excluded" ? 2 : sure.probability;
}

/** The asset before or after one, round the end; one that is not shown stands where the family has it. */
export function neighbour(
  shown: readonly string[],
  order: readonly string[],
  asset: string | null,
  by: 1 | -1,
  wanted: (asset: string) => boolean = () => true,
): string | null {
  const all = shown.length ? [...shown] : [...order];
  const here = asset === null ? -1 : all.indexOf(asset);
  const start = here >= 0 ? here : by === 1 ? -1 : 0;
  for (let k = 1; k <= all.length; k++) {
    const next = all[(start + by * k + 2 * all.length) % all.length];
    if (next !== undefined && next !== asset && wanted(next)) return next;
  }
  return null;
}

let last: { by: readonly unknown[]; shown: readonly string[] } | null = null;

/** The assets that the family shows now; the same array as long as it is the same. */
export function shownAssets(): readonly string[] {
  const { cards, order, project, confidence } = useProject.getState();
  const { filters, checks } = useWorkspace.getState();
  const by = [cards, order, project.vocabulary, confidence, filters, checks.engine];
  if (last && isEqual(last.by, by)) return last.shown;
  const fresh = filterAssets(cards, order, filters, project, checks.engine, confidence);
  const shown = last && isEqual(last.shown, fresh) ? last.shown : fresh;
  last = { by, shown };
  return shown;
}

const isEqual = (a: readonly unknown[], b: readonly unknown[]) => a.length === b.length && a.every((x, k) => x === b[k]);

/** The assets that the family shows now. */
export function useShown(): readonly string[] {
  useProject((state) => state.cards);
  useProject((state) => state.order);
  useProject((state) => state.confidence);
  useProject((state) => state.project.vocabulary);
  useWorkspace((workspace) => workspace.filters);
  return shownAssets();
}
