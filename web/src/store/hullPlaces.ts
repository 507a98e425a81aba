// Hulls by name and by position: of each asset that was looked at, and by the names they have where several assets are
// shown side by side.
import { groupBy } from "./once";

/** A hull by its asset and its name there. */
export interface HullPlace {
  readonly asset: string;
  readonly hull: string;
}

const positions = new Map<string, Map<string, number>>();
const owners = new Map<string, HullPlace>();

/** Notes which positions some hulls of an asset have. */
export function notePositions(asset: string, rows: Iterable<readonly [hull: string, position: number]>): void {
  const known = positions.get(asset) ?? new Map<string, number>();
  for (const [hull, position] of rows) known.set(hull, position);
  positions.set(asset, known);
}

/** The positions of some hulls of an asset; those that are not known are left out. */
export function positionsOf(asset: string, hulls: Iterable<string>): number[] {
  return [...hulls].flatMap((hull) => positions.get(asset)?.get(hull) ?? []);
}

/** The name of a hull where several assets are side by side. */
export function sheetName(asset: string, hull: string): string {
  const name = `${hull} · ${asset}`;
  if (!owners.has(name)) owners.set(name, { asset, hull });
  return name;
}

/** The hull that a name of the sheet stands for. */
export const placeOf = (name: string): HullPlace | undefined => owners.get(name);

/** Hulls by asset, in the order in which the assets come. */
export const byAsset = (places: Iterable<HullPlace>): Map<string, string[]> => groupBy(places, ({ asset }) => asset, ({ hull }) => hull);
