// What the pointer is about to do: the region that is drawn, and the hulls in it.
import { create } from "zustand";
import type { Region } from "../geometry/region";

interface RegionState {
  /** The box or lasso that is being drawn, in pixels of the viewport. */
  readonly drawn: Region;
  /** Hulls that it would take. */
  readonly region: ReadonlySet<string>;
}

const NOTHING: RegionState = { drawn: [], region: new Set() };

export const useRegion = create<RegionState>()(() => NOTHING);

export const setRegion = (change: Partial<RegionState>): void => useRegion.setState(change);
export const clearRegion = (): void => useRegion.setState(NOTHING);
