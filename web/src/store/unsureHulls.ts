// Hulls whose label is not sure: how many, and the queue in which each is labelled and then comes the next.
import type { Card } from "../wire";
import { UNLABELLED } from "./family";
import { labelHulls, ownHulls } from "./labels";
import { oncePerFamily, useProject } from "./project";
import { getDetails, useScenes } from "./scenes";
import { notify, reportError } from "./toasts";
import { lookFrom, openAsset, openStage, select, setBrush, setLayout, useWorkspace } from "./workspace";

/** A hull by its place in its asset. */
interface Place {
  readonly asset: string;
  readonly position: number;
}

type Cards = Readonly<Record<string, Card>>;

/** The first unsure hull after a place, or before it, starting again at the other end; null where all are sure. */
export function nextUnsure(cards: Cards, order: readonly string[], from: Place | null, by: 1 | -1 = 1): Place | null {
  const queue = order.flatMap((asset, at) =>
    [...(cards[asset]?.unsure ?? [])].sort((a, b) => a - b).map((position) => ({ asset, position, at })),
  );
  const here = from ? order.indexOf(from.asset) : -1;
  const position = from?.position ?? -1;
  const isAfter = (one: { at: number; position: number }) =>
    one.at > here || (one.at === here && one.position > position);
  const isBefore = (one: { at: number; position: number }) =>
    one.at < here || (one.at === here && one.position < position);
  const next = by === 1 ? (queue.find(isAfter) ?? queue[0]) : (queue.findLast(isBefore) ?? queue.at(-1));
  return next ? { asset: next.asset, position: next.position } : null;
}

/** Hulls of the family with and without a label, those that are unsure, and on how many assets. */
export const labelProgress = oncePerFamily((cards) => {
  const sum = { hulls: 0, labelled: 0, unsure: 0, assets: 0 };
  for (const { labels, unsure } of cards) {
    sum.hulls += labels.length;
    sum.labelled += labels.length - labels.filter((label) => label === UNLABELLED).length;
    sum.unsure += unsure.length;
    sum.assets += unsure.length ? 1 : 0;
  }
  return sum;
});

/** Hulls of the family, how many of them a person or a file labelled, and on how many assets. */
export const givenLabels = oncePerFamily((cards) => {
  const sum = { hulls: 0, given: 0, assets: 0 };
  for (const { labels, given } of cards) {
    sum.hulls += labels.length;
    sum.given += given;
    sum.assets += given ? 1 : 0;
  }
  return sum;
});

/** Whether a hull of an asset, by name, is one of those whose label is not sure. */
export function isUnsure(card: Card | undefined, own: readonly { name: string }[], name: string): boolean {
  return card?.unsure.some((position) => own[position]?.name === name) ?? false;
}

/** The hull that the queue has put in hand. */
let current: (Place & { hull: string }) | null = null;

/** Positions that were labelled since a card was sent. */
const labelledPlaces = new WeakMap<Card, Set<number>>();

/** Labels the selected hulls, or, where none is, arms the label so that clicks paint it; null takes labels away. */
export function applyLabel(label: string | null): void | Promise<void> {
  const { asset, selection, elsewhere, brush } = useWorkspace.getState();
  const hulls = ownHulls(selection);
  const paint = label ?? "";
  if (asset === null || (!hulls.length && !elsewhere.size)) return setBrush(brush === paint ? null : paint);
  setBrush(null);
  const others = [...elsewhere].flatMap(([other, names]) => names.map((hull) => ({ asset: other, hull })));
  if (others.length) return void labelHulls(asset, hulls, label, false, others);
  if (!isCurrent(asset, hulls)) return void labelHulls(asset, hulls, label);
  return label === null ? labelHulls(asset, hulls, null).then(() => undefined) : labelAndGoOn(asset, hulls, label);
}

/** The labels of the selected hulls are right: the person vouches for them; then goes on to the next unsure one. */
export async function confirmLabels(): Promise<void> {
  const { asset, selection } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset) return;
  const hulls = scene.hulls.filter((hull) => selection.has(hull.name) && hull.label !== null);
  const labels = [...new Set(hulls.map((hull) => hull.label))];
  const having = (label: string | null) => hulls.filter((hull) => hull.label === label).map((hull) => hull.name);
  for (const label of labels) if (!(await labelHulls(asset, having(label), label, true))) return;
  if (!hulls.length) return;
  noteLabelled(asset, hulls.map((hull) => hull.name));
  await goToUnsure(1, true);
}

async function labelAndGoOn(asset: string, hulls: readonly string[], label: string): Promise<void> {
  if (!(await labelHulls(asset, hulls, label, true))) return;
  noteLabelled(asset, hulls);
  await goToUnsure(1, true);
}

/** Opens the asset of the next unsure hull, or of the one before, selects the hull and looks at it.
 * labelled: one was just labelled, so that the person is notified where it was the last. */
export async function goToUnsure(by: 1 | -1 = 1, labelled = false): Promise<void> {
  const { asset, selection } = useWorkspace.getState();
  const { order } = useProject.getState();
  const { scene } = useScenes.getState();
  const own = scene?.asset === asset ? (scene?.view.hulls ?? []) : [];
  const isSelected = (hull: { name: string }) => selection.has(hull.name);
  const at = by === 1 ? own.findLastIndex(isSelected) : own.findIndex(isSelected);
  const next = nextUnsure(cardsLeft(), order, asset === null ? null : { asset, position: at }, by);
  if (!next) return labelled ? notify("No unsure label is left.") : undefined;
  openStage("label");
  openAsset(next.asset);
  setLayout({ gallery: false });
  try {
    const { view } = await getDetails(next.asset);
    const hull = view.hulls[next.position];
    if (!hull || useWorkspace.getState().asset !== next.asset) return;
    select([hull.name]);
    lookFrom("near");
    current = { ...next, hull: hull.name };
  } catch (error) {
    reportError(error);
  }
}

const isCurrent = (asset: string, hulls: readonly string[]): boolean =>
  current?.asset === asset && hulls.length === 1 && hulls[0] === current.hull;

/** Notes that hulls are labelled, until their card tells. */
function noteLabelled(asset: string, names: readonly string[]): void {
  const card = useProject.getState().cards[asset];
  const { scene } = useScenes.getState();
  if (!card || scene?.asset !== asset) return;
  const places = names.map((name) => scene.view.hulls.findIndex((hull) => hull.name === name));
  labelledPlaces.set(card, new Set([...(labelledPlaces.get(card) ?? []), ...places]));
}

/** The cards without what was labelled since they were sent. */
function cardsLeft(): Record<string, Card> {
  const { cards } = useProject.getState();
  const left = (card: Card) => card.unsure.filter((position) => !labelledPlaces.get(card)?.has(position));
  return Object.fromEntries(Object.entries(cards).map(([asset, card]) => [asset, { ...card, unsure: left(card) }]));
}
