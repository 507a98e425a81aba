// Words on cards: names that fit, and what a screen reader says.
import { unlabelled } from "../store/family";
import type { Card } from "../wire";

/** A text of at most so many letters, shortened in the middle, where ids differ least. */
export function middle(text: string, most: number): string {
  if (text.length <= most || most < 5) return text;
  const end = Math.ceil((most - 1) * 0.6);
  return `${text.slice(0, most - 1 - end)}…${text.slice(-end)}`;
}

export const hulls = (count: number): string => (count === 1 ? "1 hull" : `${count} hulls`);

export interface Badge {
  name: "unlabelled" | "unsure" | "demonstrated" | "edited" | "stale" | "accepted" | "flagged" | "failed" | "corrected";
  /** What it says, in words. */
  text: string;
  count?: number;
}

/** How an asset stands, what matters most first. */
export function badges(card: Card): readonly Badge[] {
  const bare = unlabelled(card);
  const out: (Badge | false)[] = [
    card.output === "failed" && { name: "failed", text: "The program fails on it" },
    (card.review === "flagged" || card.flags.length > 0) && { name: "flagged", text: flagged(card) },
    card.review === "accepted" && { name: "accepted", text: "Accepted" },
    card.output !== "none" && card.stale.length > 0 && { name: "stale", text: `Not up to date: ${card.stale.join(", ")}` },
    card.demonstrated && { name: "demonstrated", text: "Demonstrated" },
    card.corrections > 0 && { name: "corrected", text: card.corrections === 1 ? "1 edit by hand" : `${card.corrections} edits by hand`, count: card.corrections },
    card.output === "edited" && card.review === null && { name: "edited", text: "Edited by the program" },
    card.unsure.length > 0 && {
      name: "unsure",
      text: card.unsure.length === 1 ? "1 label is not sure" : `${card.unsure.length} labels are not sure`,
      count: card.unsure.length,
    },
    bare > 0 && { name: "unlabelled", text: bare === 1 ? "1 hull has no label" : `${bare} hulls have no label`, count: bare },
  ];
  return out.filter((badge) => badge !== false);
}

function flagged(card: Card): string {
  const reasons = [card.note, ...card.flags].filter(Boolean);
  return reasons.length ? `Flagged: ${reasons.join("; ")}` : "Flagged";
}

/** A card as a screen reader says it. */
export function spoken(card: Card): string {
  const amount = card.hulls === null ? (card.error ?? "being read") : hulls(card.hulls);
  const after = card.after !== null && card.output !== "none" ? `, ${card.after} after` : "";
  return [card.asset, amount + after, ...badges(card).map((badge) => badge.text)].join("; ");
}
