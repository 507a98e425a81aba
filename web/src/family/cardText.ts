// Signs and words on cards, and what a screen reader says.
import { Check, CircleAlert, CircleDashed, CircleDot, CircleQuestionMark, Flag, Hand, type LucideIcon, Pencil, RefreshCw, Tag, TriangleAlert, X } from "lucide-react";
import { countByEdit, faultsOf, findingsText } from "../store/checks";
import { flagsOf, isVoid } from "../store/goals";
import { countUnsure, matchesFilter, unlabelled } from "../store/family";
import { countText } from "../store/words";
import type { FilterName } from "../store/workspace";
import type { Card } from "../wire";

export interface Badge {
  name: FilterName | "corrected";
  /** What it says, in words. */
  text: string;
  count?: number;
  /** Whether it was there before the edit already. */
  old?: boolean;
}

/** Signs, each a shape of its own, and what they mean. */
export const SIGNS: Readonly<Record<Badge["name"], { Icon: LucideIcon; meaning: string }>> = {
  failed: { Icon: CircleAlert, meaning: "The program fails on it, or it cannot be read" },
  wrong: { Icon: X, meaning: "You called its result wrong" },
  flagged: { Icon: Flag, meaning: "Its result is flagged, for example as a goal fails" },
  "needs review": { Icon: CircleQuestionMark, meaning: "Its result needs review" },
  accepted: { Icon: Check, meaning: "You accepted its result" },
  stale: { Icon: RefreshCw, meaning: "Its result is not up to date" },
  findings: { Icon: TriangleAlert, meaning: "Findings of the checks, with their number" },
  demonstrated: { Icon: CircleDot, meaning: "You showed steps on it" },
  corrected: { Icon: Hand, meaning: "Edits by hand, with their number" },
  edited: { Icon: Pencil, meaning: "Edited by the program" },
  unsure: { Icon: CircleDashed, meaning: "Labels that are not sure, with their number" },
  unlabelled: { Icon: Tag, meaning: "Hulls without a label, with their number; not shown while no hull of the family has one" },
};

/** How an asset stands, what matters most first; engine: whose limits count; isBare: whether no hull of the family has a label. */
export function badgesOf(card: Card, engine = "", isBare = false): readonly Badge[] {
  const { output, review, manual_edits: corrections, stale } = card;
  const [bare, unsure] = [isBare ? 0 : unlabelled(card), countUnsure(card)];
  const [faults, flags] = [faultsOf(card, engine), flagsOf(card)];
  const out: (Badge | false)[] = [
    output === "failed" && { name: "failed", text: "The program fails on it" },
    review === "wrong" && { name: "wrong", text: ["Wrong", card.note].filter(Boolean).join(": ") },
    flags.length > 0 && { name: "flagged", text: `Flagged: ${flags.join("; ")}` },
    review === "accepted" && !isVoid(card) && { name: "accepted", text: "Accepted" },
    matchesFilter(card, "stale") && { name: "stale", text: `Not up to date: ${stale.join(", ")}` },
    faults.length > 0 && { name: "findings", count: faults.length, text: findingsText(faults), old: !countByEdit(faults) },
    card.demonstrated && { name: "demonstrated", text: "Demonstrated" },
    corrections > 0 && { name: "corrected", count: corrections, text: countText(corrections, "edit by hand", "edits by hand") },
    output === "edited" && review === null && { name: "edited", text: "Edited by the program" },
    unsure > 0 && { name: "unsure", count: unsure, text: countText(unsure, "label is not sure", "labels are not sure") },
    bare > 0 && { name: "unlabelled", count: bare, text: countText(bare, "hull has no label", "hulls have no label") },
  ];
  return out.filter((badge) => badge !== false);
}

const WIDE = 16; // pixels that a sign takes
const DIGIT = 7;

/** The first, and those after it that fit into a width [px]; all stand in the tooltip. */
export function fitBadges(all: readonly Badge[], room: number): readonly Badge[] {
  let left = room;
  return all.filter(({ count }, k) => (left -= WIDE + (count === undefined ? 0 : DIGIT * String(count).length)) >= 0 || k === 0);
}

/** A card as a screen reader says it. */
export function cardText(card: Card, engine = ""): string {
  const amount = card.hulls === null ? (card.error ?? "being read") : countText(card.hulls, "hull");
  const after = card.after !== null && card.output !== "none" ? `, ${card.after} after` : "";
  return [card.asset, amount + after, ...badgesOf(card, engine).map((badge) => badge.text)].join("; ");
}
