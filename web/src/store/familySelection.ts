// What is selected on several assets: how many hulls on which, and taking some of them off.
import { useMemo } from "react";
import { byAsset, placeOf, positionsOf } from "./hullPlaces";
import { allSelected, selectPlaces, useWorkspace } from "./workspace";

/** Whether hulls of assets are selected that are not shown, or several assets are shown. */
const isWide = ({ sheet, elsewhere }: { sheet: readonly string[]; elsewhere: ReadonlyMap<string, unknown> }): boolean =>
  sheet.length > 0 || elsewhere.size > 0;

/** The positions of the selected hulls of an asset, while hulls of several assets are selected; else undefined. */
export function useSelectedPositions(asset: string): readonly number[] | undefined {
  const text = useWorkspace((workspace) => {
    const { elsewhere, sheet, selection, asset: open } = workspace;
    if (!isWide(workspace) || (!elsewhere.size && !selection.size)) return undefined;
    const names = elsewhere.get(asset) ?? shownNames(asset, open, sheet, selection);
    return positionsOf(asset, names).join(" ");
  });
  return useMemo(() => (text === undefined ? undefined : text.split(" ").filter(Boolean).map(Number)), [text]);
}

function shownNames(asset: string, open: string | null, sheet: readonly string[], selection: ReadonlySet<string>): string[] {
  if (!sheet.length) return asset === open ? [...selection] : [];
  return byAsset([...selection].flatMap((name) => placeOf(name) ?? [])).get(asset) ?? [];
}

/** How many hulls are selected on each asset that has some. */
export function selectedByAsset(): ReadonlyMap<string, readonly string[]> {
  return byAsset(allSelected());
}

/** Takes the hulls of an asset off the selection. */
export function unselectAsset(asset: string): void {
  selectPlaces(allSelected().filter((place) => place.asset !== asset));
}
