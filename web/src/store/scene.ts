// What the viewport shows: an asset in one state, or several side by side.
import type { Shape } from "../server/packet";
import type { AssetView, EditHeader, HullView, NonConvexView } from "../wire";
import type { Showing } from "./workspace";

export interface SceneHull extends HullView {
  readonly shape: Shape;
  /** Whether the original asset lacks it. */
  readonly made: boolean;
}

/** One of several assets side by side. */
export interface ScenePart {
  readonly asset: string;
  /** Its lowest and highest corner where it stands [m]. */
  readonly low: readonly [number, number, number];
  readonly high: readonly [number, number, number];
  /** By how much it is drawn larger than it is. */
  readonly scale: number;
}

/** What the viewport shows of an asset in one state. */
export interface Scene {
  readonly asset: string;
  readonly showing: Showing;
  readonly view: AssetView;
  readonly hulls: readonly SceneHull[];
  readonly opaque: readonly (NonConvexView & { shape: Shape })[];
  readonly contacts: readonly (readonly [string, string])[];
  /** Header of the edit that led here; null for the original asset. */
  readonly edit: EditHeader | null;
  /** The assets side by side, the open one among them; left out where it is alone. */
  readonly parts?: readonly ScenePart[];
  /** Whether their sizes differ so much that they can be drawn in one size. */
  readonly isUneven?: boolean;
}
