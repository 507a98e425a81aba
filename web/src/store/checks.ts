// Measurements of the result in view, part after part, and which of their findings count.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Card, CheckResult, Fault, Problem } from "../wire";
import { countText } from "./words";
import { select, useWorkspace, visit } from "./workspace";

export type Part = CheckResult["part"];
/** In the order in which they are measured, what is quickest first. */
export const PARTS: readonly Part[] = ["engines", "physics", "clearance", "fit"];

type Measurement =
  | { kind: "coming" }
  | { kind: "there"; checked: CheckResult }
  | { kind: "problem"; problem: Problem };

interface ChecksState {
  parts: Readonly<Record<string, Measurement>>;
  /** Counts up when something is to be tried again. */
  tries: number;
  /** The parts whose pictures are shown. */
  pictured: readonly Part[];
}

export const useChecks = create<ChecksState>()(() => ({ parts: {}, tries: 0, pictured: [] }));

const MOST = 400;
/** Milliseconds that an asset is looked at before anything is measured: who passes by does not want it. */
export const DELAY = 200;

/** By what a part is kept; version: the digest on the card. */
export const partKey = (asset: string, version: string, part: Part): string => `${asset}\n${version}\n${part}`;

/** Measures what is not known yet of the output of an asset, until the returned function is called. */
export function measure(asset: string, version: string): () => void {
  const stop = new AbortController();
  const timer = setTimeout(() => void measureAll(asset, version, stop.signal), DELAY);
  return () => {
    clearTimeout(timer);
    stop.abort();
  };
}

async function measureAll(asset: string, version: string, stop: AbortSignal): Promise<void> {
  for (const part of PARTS) {
    if (stop.aborted) return;
    const key = partKey(asset, version, part);
    if (useChecks.getState().parts[key]) continue;
    keepPart(key, { kind: "coming" });
    keepPart(key, await fetchPart(asset, part, stop));
  }
}

/** What the server says; null where nobody waits for it any more. */
async function fetchPart(asset: string, part: Part, stop: AbortSignal): Promise<Measurement | null> {
  try {
    return { kind: "there", checked: await api.checked(asset, part, stop) };
  } catch (error) {
    if (stop.aborted) return null;
    if (error instanceof ServerProblem) return { kind: "problem", problem: error.problem };
    throw error;
  }
}

function keepPart(key: string, now: Measurement | null): void {
  useChecks.setState(({ parts }) => {
    const kept = Object.entries(parts).filter(([one]) => one !== key).slice(1 - MOST);
    return { parts: Object.fromEntries(now ? [...kept, [key, now]] : kept) };
  });
}

/** Measures a part anew that could not be measured. */
export function retryPart(asset: string, version: string, part: Part): void {
  keepPart(partKey(asset, version, part), null);
  useChecks.setState(({ tries }) => ({ tries: tries + 1 }));
}

export const useShowsPictures = (part: Part): boolean => useChecks(({ pictured }) => pictured.includes(part));

/** Shows the pictures of a part, of this and all other results, or no longer. */
export function showPictures(part: Part, on: boolean): void {
  useChecks.setState(({ pictured }) => ({ pictured: [...pictured.filter((one) => one !== part), ...(on ? [part] : [])] }));
}

/** Selects hulls of the output of an asset, which comes into view where something else is shown. */
export function selectInOutput(asset: string, hulls: readonly string[]): void {
  const { showing } = useWorkspace.getState();
  if (showing.kind === "result" && showing.of === "output") select(hulls);
  else visit(asset, { kind: "result", of: "output" }, hulls);
}

/** Whether a finding counts; the limits of other engines do not. */
export const concerns = ({ engine }: { engine: string | null }, chosen: string): boolean => engine === null || engine === chosen;

/** What was found of the output of a card; nothing where it was not checked. */
export const faultsOf = ({ faults }: Card, engine: string): readonly Fault[] =>
  faults?.filter((fault) => concerns(fault, engine)) ?? [];

/** How many of them came with the edit. */
export const countByEdit = (faults: readonly Fault[]): number => faults.filter((fault) => fault.new).length;

/** `3 findings of the checks, 1 by the edit`. */
export function findingsText(faults: readonly Fault[]): string {
  const fresh = countByEdit(faults);
  const whose = fresh === faults.length ? "by the edit" : fresh ? `${fresh} by the edit` : "all as before the edit";
  return `${countText(faults.length, "finding")} of the checks, ${whose}`;
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
export const countUnchecked = (cards: readonly Card[]): number =>
  cards.filter((card) => card.check !== null && card.faults === null).length;
