// What the last edit of all labels changed, as long as it was the last one and nobody put it aside.
import { useMemo } from "react";
import { create } from "zustand";
import type { Relabelled, RelabelledAsset } from "../wire";
import { openAsset, setHighlight, useDesk } from "./desk";
import { neighbour } from "./family";
import { useProject } from "./project";

/** Which of the changed hulls are meant. */
export type Sort = "new" | "changed";

const WHAT = "relabelled";

/** The one that was put aside. */
const useAside = create<{ what: Relabelled | null }>()(() => ({ what: null }));

/** What changed; null where the last edit was another one, or this was put aside. */
export function presentRelabelled(): Relabelled | null {
  const { relabelled } = useProject.getState();
  return relabelled === useAside.getState().what ? null : relabelled;
}

export function useRelabelled(): Relabelled | null {
  const relabelled = useProject((state) => state.relabelled);
  const aside = useAside(({ what }) => what);
  return relabelled === aside ? null : relabelled;
}

/** What changed on one asset. */
export function useRelabelledAsset(asset: string): RelabelledAsset | null {
  const relabelled = useRelabelled();
  return relabelled && (rowsOf(relabelled).get(asset) ?? null);
}

export const relabelledOn = (asset: string): RelabelledAsset | null => {
  const relabelled = presentRelabelled();
  return relabelled && (rowsOf(relabelled).get(asset) ?? null);
};

/** The label that each hull of an asset as it comes had before, by name; hulls whose label stayed are not among them. */
export function useFormerLabels(asset: string, own: readonly { name: string }[]): ReadonlyMap<string, string> {
  const found = useRelabelledAsset(asset);
  return useMemo(() => {
    const rows = found?.changed.map((place, k) => [own[place]?.name ?? "", found.was[k] ?? ""] as const);
    return new Map(rows);
  }, [found, own]);
}

/** Calls back whenever what is shown of it may be another, until the returned function is called. */
export function watchRelabelled(changed: () => void): () => void {
  const stops = [
    useProject.subscribe((now, before) => now.relabelled !== before.relabelled && changed()),
    useAside.subscribe(changed),
  ];
  return () => stops.forEach((stop) => stop());
}

/** No longer points out what changed; the labels stay. */
export function putAside(): void {
  unlightRelabelled();
  useAside.setState({ what: useProject.getState().relabelled });
}

/** Hulls of one sort, and on how many assets. */
export function tally({ assets }: Relabelled, sort: Sort): { hulls: number; assets: number } {
  const counts = assets.map((one) => one[sort].length).filter(Boolean);
  return { hulls: counts.reduce((sum, count) => sum + count, 0), assets: counts.length };
}

/** Points out the hulls of one sort in the family. */
export function lightRelabelled({ assets }: Relabelled, sort: Sort): void {
  const having = assets.filter((one) => one[sort].length);
  setHighlight({ what: WHAT, assets: Object.fromEntries(having.map((one) => [one.asset, one[sort]])) });
}

export function unlightRelabelled(): void {
  if (useDesk.getState().highlight?.what === WHAT) setHighlight(null);
}

/** Opens the next asset with hulls of one sort. */
export function nextRelabelled(relabelled: Relabelled, sort: Sort): void {
  const { order } = useProject.getState();
  const has = (asset: string) => Boolean(rowsOf(relabelled).get(asset)?.[sort].length);
  const next = neighbour(order, order, useDesk.getState().asset, 1, has);
  if (next !== null) openAsset(next);
}

const known = new WeakMap<Relabelled, ReadonlyMap<string, RelabelledAsset>>();

function rowsOf(relabelled: Relabelled): ReadonlyMap<string, RelabelledAsset> {
  const rows = known.get(relabelled) ?? new Map(relabelled.assets.map((one) => [one.asset, one]));
  known.set(relabelled, rows);
  return rows;
}
