// Which hulls have no sure label, and the next of them in the order of the family.
import type { Card } from "../wire";

/** A hull by its place in its asset. */
export interface Place {
  readonly asset: string;
  readonly position: number;
}

type Cards = Readonly<Record<string, Card>>;

/** The first unsure hull after a place, starting again at the front; null where all are sure. */
export function nextUnsure(cards: Cards, order: readonly string[], from: Place | null): Place | null {
  const queue = order.flatMap((asset, at) =>
    [...(cards[asset]?.unsure ?? [])].sort((a, b) => a - b).map((position) => ({ asset, position, at })),
  );
  const here = from ? order.indexOf(from.asset) : -1;
  const after = queue.find((one) => one.at > here || (one.at === here && one.position > (from?.position ?? -1)));
  const next = after ?? queue[0];
  return next ? { asset: next.asset, position: next.position } : null;
}

/** Hulls of the family with and without a label, those that are unsure, and on how many assets. */
export function labelProgress(cards: Cards): { hulls: number; labelled: number; unsure: number; assets: number } {
  const sum = { hulls: 0, labelled: 0, unsure: 0, assets: 0 };
  for (const { labels, unsure } of Object.values(cards)) {
    sum.hulls += labels.length;
    sum.labelled += labels.filter((label) => label >= 0).length;
    sum.unsure += unsure.length;
    sum.assets += unsure.length ? 1 : 0;
  }
  return sum;
}

/** Whether a hull of an asset, by name, is one of those whose label is not sure. */
export function isUnsure(card: Card | undefined, own: readonly { name: string }[], name: string): boolean {
  return card?.unsure.some((position) => own[position]?.name === name) ?? false;
}
