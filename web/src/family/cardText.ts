// Words on cards: names that fit, and what a screen reader says.
import { countByEdit, faultsOf, findingsText } from "../store/checks";
import { flagsOf } from "../store/goals";
import { countUnsure, matchesFilter, unlabelled } from "../store/family";
import type { FilterName } from "../store/workspace";
import type { Card } from "../wire";

export const hullsText = (count: number): string => (count === 1 ? "1 hull" : `${count} hulls`);

export interface Badge {
  name: FilterName | "corrected";
  /** What it says, in words. */
  text: string;
  count?: number;
  /** Whether it was there before the edit already. */
  old?: boolean;
}

/** How an asset stands, what matters most first; engine: whose limits count. */
export function badgesOf(card: Card, engine = ""): readonly Badge[] {
  const { output, review, manual_edits: corrections, stale } = card;
  const [bare, unsure] = [unlabelled(card), countUnsure(card)];
  const [faults, flags] = [faultsOf(card, engine), flagsOf(card)];
  const out: (Badge | false)[] = [
    output === "failed" && { name: "failed", text: "The program fails on it" },
    review === "wrong" && { name: "wrong", text: ["Wrong", card.note].filter(Boolean).join(": ") },
    flags.length > 0 && { name: "flagged", text: `Flagged: ${flags.join("; ")}` },
    review === "accepted" && { name: "accepted", text: "Accepted" },
    matchesFilter(card, "stale") && { name: "stale", text: `Not up to date: ${stale.join(", ")}` },
    faults.length > 0 && { name: "findings", count: faults.length, text: findingsText(faults), old: !countByEdit(faults) },
    card.demonstrated && { name: "demonstrated", text: "Demonstrated" },
    corrections > 0 && countBadge("corrected", corrections, "edit by hand", "edits by hand"),
    output === "edited" && review === null && { name: "edited", text: "Edited by the program" },
    unsure > 0 && countBadge("unsure", unsure, "label is not sure", "labels are not sure"),
    bare > 0 && countBadge("unlabelled", bare, "hull has no label", "hulls have no label"),
  ];
  return out.filter((badge) => badge !== false);
}

const countBadge = (name: Badge["name"], count: number, one: string, several: string): Badge => ({
  name,
  count,
  text: count === 1 ? `1 ${one}` : `${count} ${several}`,
});

const SIGN = 16; // pixels that a sign takes
const DIGIT = 7;

/** Those that fit into a width [px], and the rest, which then takes the place of a sign. */
export function fitBadges(all: readonly Badge[], room: number): { shown: readonly Badge[]; rest: readonly Badge[] } {
  const widths = all.map(({ count }) => SIGN + (count === undefined ? 0 : DIGIT * String(count).length));
  const sum = (count: number) => widths.slice(0, count).reduce((a, b) => a + b, 0);
  if (sum(all.length) <= room) return { shown: all, rest: [] };
  const most = widths.findLastIndex((_, k) => sum(k) + SIGN <= room);
  return { shown: all.slice(0, Math.max(most, 0)), rest: all.slice(Math.max(most, 0)) };
}

/** A card as a screen reader says it. */
export function cardText(card: Card, engine = ""): string {
  const amount = card.hulls === null ? (card.error ?? "being read") : hullsText(card.hulls);
  const after = card.after !== null && card.output !== "none" ? `, ${card.after} after` : "";
  return [card.asset, amount + after, ...badgesOf(card, engine).map((badge) => badge.text)].join("; ");
}
