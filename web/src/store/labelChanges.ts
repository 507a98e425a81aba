// What the last edit of all labels changed, as long it was the last one and nobody dismissed it.
import { useMemo } from "react";
import type { LabelUpdate, AssetLabelUpdate } from "../wire";
import { neighbour } from "./family";
import { oncePer } from "./once";
import { useProject } from "./project";
import { openAsset, useWorkspace } from "./workspace";

/** Which of the changed hulls are meant. */
export type ChangeKind = "new" | "changed";

const rowsOf = oncePer((relabelled: LabelUpdate) => new Map(relabelled.assets.map((one) => [one.asset, one])));

/** What changed on one asset; null where the last edit was another one, or this was dismissed. */
export const labelChangesOf = (asset: string): AssetLabelUpdate | null => rowOf(useProject.getState().relabelled, asset);

export const useLabelChangesOf = (asset: string): AssetLabelUpdate | null => rowOf(useProject((state) => state.relabelled), asset);

function rowOf(relabelled: LabelUpdate | null, asset: string): AssetLabelUpdate | null {
  return relabelled && (rowsOf(relabelled).get(asset) ?? null);
}

/** The label that each hull of an original asset had before, by name; hulls whose label stayed are not among them. */
export function useFormerLabels(asset: string, own: readonly { name: string }[]): ReadonlyMap<string, string> {
  const found = useLabelChangesOf(asset);
  return useMemo(() => {
    const rows = found?.changed.map((place, k) => [own[place]?.name ?? "", found.was[k] ?? ""] as const);
    return new Map(rows);
  }, [found, own]);
}

/** Calls back whenever what is shown of it may be another, until the returned function is called. */
export function watchLabelChanges(changed: () => void): () => void {
  return useProject.subscribe((now, before) => now.relabelled !== before.relabelled && changed());
}

/** No longer points out what changed; the labels stay. */
export const dismissLabelChanges = (): void => useProject.setState({ relabelled: null });

/** Hulls of one sort, and on how many assets. */
export function countChanges({ assets }: LabelUpdate, sort: ChangeKind): { hulls: number; assets: number } {
  const counts = assets.map((one) => one[sort].length).filter(Boolean);
  return { hulls: counts.reduce((sum, count) => sum + count, 0), assets: counts.length };
}

/** Opens the next asset with hulls of one sort. */
export function openNextChange(relabelled: LabelUpdate, sort: ChangeKind): void {
  const { order } = useProject.getState();
  const has = (asset: string) => Boolean(rowsOf(relabelled).get(asset)?.[sort].length);
  const next = neighbour(order, order, useWorkspace.getState().asset, 1, has);
  if (next !== null) openAsset(next);
}

