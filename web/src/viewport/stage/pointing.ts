// What the pointer is about to do: the region that is drawn, and the hulls in it.
import { create } from "zustand";
import type { Region } from "../picking/region";

export interface Pointing {
  /** The box or lasso that is being drawn, in pixels of the viewport. */
  readonly drawn: Region;
  /** Hulls that it would take. */
  readonly region: ReadonlySet<string>;
}

const NOTHING: Pointing = { drawn: [], region: new Set() };

export const usePointing = create<Pointing>()(() => NOTHING);

export const point = (change: Partial<Pointing>): void => usePointing.setState(change);
export const pointNowhere = (): void => usePointing.setState(NOTHING);
