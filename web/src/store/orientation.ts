// The landmarks of the orientation: which pairs there are after a click.
import type { AxisLandmarks, OrientView } from "../wire";

type Pairs = Pick<OrientView, "snap" | "pairs">;

/** The orientation with a pair for a direction; it takes the place of one along the same axis, or else of the last of two. */
export function withPair({ snap, pairs }: Pairs, pair: AxisLandmarks): Pairs {
  const same = pairs.findIndex(({ axis }) => axis.slice(1) === pair.axis.slice(1));
  const at = same >= 0 ? same : Math.min(pairs.length, 1);
  return { snap, pairs: [...pairs.slice(0, at), pair, ...pairs.slice(at + 1)] };
}

export function withoutPair({ snap, pairs }: Pairs, at: number): Pairs {
  return { snap, pairs: pairs.filter((_, k) => k !== at) };
}

/** The landmarks that two clicked hulls stand for, or why they cannot be landmarks. */
export function pairFromClicks(axis: AxisLandmarks["axis"], start: string | null, end: string | null): AxisLandmarks | string {
  if (start === null || end === null) return "A hull without a label cannot be a landmark: label it first.";
  if (start === end) return `Both hulls are labelled ${start}: landmarks have two different labels.`;
  return { axis, start, end };
}
