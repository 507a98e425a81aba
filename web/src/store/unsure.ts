// Which hulls have no sure label, the next of them in the order of the family, and who gave the others.
import type { Card } from "../wire";

/** A hull by its place in its asset. */
export interface Place {
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

/** Hulls of the family, how many of them a person or a file labelled, and on how many assets. */
export function givenLabels(cards: Cards): { hulls: number; given: number; assets: number } {
  const sum = { hulls: 0, given: 0, assets: 0 };
  for (const { labels, given } of Object.values(cards)) {
    sum.hulls += labels.length;
    sum.given += given;
    sum.assets += given ? 1 : 0;
  }
  return sum;
}

/** Whether a hull of an asset, by name, is one of those whose label is not sure. */
export function isUnsure(card: Card | undefined, own: readonly { name: string }[], name: string): boolean {
  return card?.unsure.some((position) => own[position]?.name === name) ?? false;
}
