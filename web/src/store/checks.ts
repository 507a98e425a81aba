// What is measured of the result in view: part after part, stopped when one goes on, kept as long as the output stays.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Checked, Problem } from "../wire";
import { select, useDesk, visit } from "./desk";

export type Part = Checked["part"];
/** In the order in which they are measured, what is quickest first. */
export const PARTS: readonly Part[] = ["engines", "physics", "clearance", "fit"];

export type Measured =
  | { kind: "coming" }
  | { kind: "there"; checked: Checked }
  | { kind: "problem"; problem: Problem };

interface ChecksState {
  parts: Readonly<Record<string, Measured>>;
  /** Counts up when something is to be tried again. */
  tries: number;
  /** The parts whose pictures are shown. */
  pictured: readonly Part[];
}

export const useChecks = create<ChecksState>()(() => ({ parts: {}, tries: 0, pictured: [] }));

const MOST = 400;
/** Milliseconds that an asset is looked at before anything is measured: who passes by does not want it. */
export const PASSING = 200;

/** By what a part is kept; version: the digest on the card. */
export const partKey = (asset: string, version: string, part: Part): string => `${asset}\n${version}\n${part}`;

/** Measures what is not known yet of the output of an asset, until the returned function is called. */
export function measure(asset: string, version: string): () => void {
  const stop = new AbortController();
  const timer = setTimeout(() => void measureAll(asset, version, stop.signal), PASSING);
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
    put(key, { kind: "coming" });
    put(key, await asked(asset, part, stop));
  }
}

/** What the server says; null where nobody waits for it any more. */
async function asked(asset: string, part: Part, stop: AbortSignal): Promise<Measured | null> {
  try {
    return { kind: "there", checked: await api.checked(asset, part, stop) };
  } catch (error) {
    if (stop.aborted) return null;
    if (error instanceof ServerProblem) return { kind: "problem", problem: error.problem };
    throw error;
  }
}

function put(key: string, now: Measured | null): void {
  useChecks.setState(({ parts }) => {
    const kept = Object.entries(parts).filter(([one]) => one !== key).slice(1 - MOST);
    return { parts: Object.fromEntries(now ? [...kept, [key, now]] : kept) };
  });
}

/** Measures a part anew that could not be measured. */
export function again(asset: string, version: string, part: Part): void {
  put(partKey(asset, version, part), null);
  useChecks.setState(({ tries }) => ({ tries: tries + 1 }));
}

export const usePictured = (part: Part): boolean => useChecks(({ pictured }) => pictured.includes(part));

/** Shows the pictures of a part, of this and all other results, or no longer. */
export function showPictures(part: Part, on: boolean): void {
  useChecks.setState(({ pictured }) => ({ pictured: [...pictured.filter((one) => one !== part), ...(on ? [part] : [])] }));
}

/** Selects hulls of the output of an asset, which comes into view where something else is shown. */
export function selectInOutput(asset: string, hulls: readonly string[]): void {
  const { showing } = useDesk.getState();
  if (showing.kind === "result" && showing.of === "output") select(hulls);
  else visit(asset, { kind: "result", of: "output" }, hulls);
}
