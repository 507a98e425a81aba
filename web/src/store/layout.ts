// How the window is divided; knows no DOM. (Widths of the columns are on the desk.)
import { create } from "zustand";

export interface LayoutState {
  /** Whether the family's column is there. */
  family: boolean;
  /** Whether the family fills the centre. */
  gallery: boolean;
  /** The share of the right column that the panel has above the list of hulls. */
  split: number;
}

export const initialLayout: LayoutState = { family: true, gallery: false, split: 0.68 };

export const useLayout = create<LayoutState>()(() => initialLayout);

export function setLayout(change: Partial<LayoutState>): void {
  useLayout.setState(change);
}
