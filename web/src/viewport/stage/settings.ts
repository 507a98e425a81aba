// What of the desk's view settings the picture needs.
import type { Compare, ViewSettings } from "../../store/desk";

export interface Settings {
  readonly projection: ViewSettings["projection"];
  readonly wireframe: boolean;
  readonly opaque: boolean;
  readonly grid: boolean;
  readonly ghost: boolean;
  readonly contacts: boolean;
  readonly compare: Compare;
  readonly divider: number;
  /** How far hulls move away, in their distances from the centre. */
  readonly explode: number;
}

const FARTHEST = 1.4;

export const settingsOf = (view: ViewSettings): Settings => ({ ...view, explode: FARTHEST * view.explode });
