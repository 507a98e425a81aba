// Labelling what is selected, and going through the hulls whose label is not sure: each is labelled, then comes the next.
import type { Card } from "../wire";
import { lookFrom, openAsset, openStage, select, setBrush, useDesk } from "./desk";
import { labelHulls, ownHulls } from "./labelling";
import { setLayout } from "./layout";
import { useProject } from "./project";
import { details, useScenes } from "./scenes";
import { complainedOf, told } from "./toasts";
import { nextUnsure, type Place } from "./unsure";

/** The hull that the queue has put in hand. */
let inHand: (Place & { hull: string }) | null = null;

/** Positions that were labelled since a card was told. */
const settled = new WeakMap<Card, Set<number>>();

/** Labels the selected hulls, or, where none is, arms the label so that clicks paint it; null takes labels away. */
export function applyLabel(label: string | null): void | Promise<void> {
  const { asset, selection, brush } = useDesk.getState();
  const hulls = ownHulls(selection);
  const paint = label ?? "";
  if (asset === null || !hulls.length) return setBrush(brush === paint ? null : paint);
  setBrush(null);
  if (!isInHand(asset, hulls)) return void labelHulls(asset, hulls, label);
  return label === null ? labelHulls(asset, hulls, null).then(() => undefined) : labelAndGoOn(asset, hulls, label);
}

/** The labels of the selected hulls are right: the person vouches for them; then goes on to the next unsure one. */
export async function confirmLabels(): Promise<void> {
  const { asset, selection } = useDesk.getState();
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset) return;
  const hulls = scene.hulls.filter((hull) => selection.has(hull.name) && hull.label !== null);
  const labels = [...new Set(hulls.map((hull) => hull.label))];
  const having = (label: string | null) => hulls.filter((hull) => hull.label === label).map((hull) => hull.name);
  for (const label of labels) if (!(await labelHulls(asset, having(label), label, true))) return;
  if (!hulls.length) return;
  settle(asset, hulls.map((hull) => hull.name));
  await goToUnsure(1, true);
}

async function labelAndGoOn(asset: string, hulls: readonly string[], label: string): Promise<void> {
  if (!(await labelHulls(asset, hulls, label, true))) return;
  settle(asset, hulls);
  await goToUnsure(1, true);
}

/** Opens the asset of the next unsure hull, or of the one before, selects the hull and looks at it.
 * labelled: one was just labelled, so that it is told where it was the last. */
export async function goToUnsure(by: 1 | -1 = 1, labelled = false): Promise<void> {
  const { asset, selection } = useDesk.getState();
  const { order } = useProject.getState();
  const { scene } = useScenes.getState();
  const own = scene?.asset === asset ? (scene?.view.hulls ?? []) : [];
  const isSelected = (hull: { name: string }) => selection.has(hull.name);
  const at = by === 1 ? own.findLastIndex(isSelected) : own.findIndex(isSelected);
  const next = nextUnsure(unsettled(), order, asset === null ? null : { asset, position: at }, by);
  if (!next) return labelled ? told("Every label is sure.") : undefined;
  openStage("label");
  openAsset(next.asset);
  setLayout({ gallery: false });
  try {
    const { view } = await details(next.asset);
    const hull = view.hulls[next.position];
    if (!hull || useDesk.getState().asset !== next.asset) return;
    select([hull.name]);
    lookFrom("near");
    inHand = { ...next, hull: hull.name };
  } catch (error) {
    complainedOf(error);
  }
}

const isInHand = (asset: string, hulls: readonly string[]): boolean =>
  inHand?.asset === asset && hulls.length === 1 && hulls[0] === inHand.hull;

/** Notes that hulls are labelled, until their card tells. */
function settle(asset: string, names: readonly string[]): void {
  const card = useProject.getState().cards[asset];
  const { scene } = useScenes.getState();
  if (!card || scene?.asset !== asset) return;
  const places = names.map((name) => scene.view.hulls.findIndex((hull) => hull.name === name));
  settled.set(card, new Set([...(settled.get(card) ?? []), ...places]));
}

/** The cards without what was labelled since they were told. */
function unsettled(): Record<string, Card> {
  const { cards } = useProject.getState();
  const left = (card: Card) => card.unsure.filter((position) => !settled.get(card)?.has(position));
  return Object.fromEntries(Object.entries(cards).map(([asset, card]) => [asset, { ...card, unsure: left(card) }]));
}
