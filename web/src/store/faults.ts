// What checks found of an output, as far as it counts for the engine that the person chose.
import type { Card, Fault } from "../wire";
import { counted } from "./words";

/** Whether a finding counts; the limits of other engines do not. */
export const counts = ({ engine }: { engine: string | null }, chosen: string): boolean => engine === null || engine === chosen;

/** What was found of the output of a card; nothing where it was not checked. */
export const faultsOf = ({ faults }: Card, engine: string): readonly Fault[] =>
  faults?.filter((fault) => counts(fault, engine)) ?? [];

/** How many of them came with the edit. */
export const byEdit = (faults: readonly Fault[]): number => faults.filter((fault) => fault.new).length;

/** `3 findings of the checks, 1 by the edit`. */
export function foundText(faults: readonly Fault[]): string {
  const fresh = byEdit(faults);
  const whose = fresh === faults.length ? "by the edit" : fresh ? `${fresh} by the edit` : "all as before the edit";
  return `${counted(faults.length, "finding")} of the checks, ${whose}`;
}

/** What a rule is about, in words: `Sticks out`, `Vertices`. */
export function ruleTitle({ rule, engine }: Pick<Fault, "rule" | "engine">): string {
  const name = engine === null ? rule.slice(rule.indexOf("-") + 1) : rule.slice(engine.length + 1);
  const words = TITLES[name] ?? name.replaceAll("-", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

const TITLES: Readonly<Record<string, string>> = { out: "sticks out", bare: "uncovered", inner: "inside another", centre: "centre of mass" };

/** How bad it is: an error counts more than any warnings, what came with the edit more than what was there before; −1 where
 * it was not checked. */
export function weightOf(card: Card, engine: string): number {
  if (card.faults === null) return -1;
  return faultsOf(card, engine).reduce((sum, { severity, new: fresh }) => sum + (severity === "error" ? 1000 : 1) * (fresh ? 10 : 1), 0);
}

/** How many outputs were not checked as they are. */
export const unchecked = (cards: readonly Card[]): number =>
  cards.filter((card) => card.check !== null && card.faults === null).length;
