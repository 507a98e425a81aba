// The outline of a convex shape in the picture, and whether a region that a person draws meets it.
import { isInside, type Region, type Spot } from "./region";

/** The corners of the smallest convex outline around some spots, in order (monotone chain, Andrew, 1979). */
export function outlineOf(spots: readonly Spot[]): Spot[] {
  const sorted = [...spots].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const half = (all: readonly Spot[]): Spot[] => {
    const out: Spot[] = [];
    for (const spot of all) {
      while (out.length > 1 && turn(out.at(-2) as Spot, out.at(-1) as Spot, spot) <= 0) out.pop();
      out.push(spot);
    }
    return out.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Whether a region and a convex outline have a spot in common. */
export function meets(region: Region, outline: readonly Spot[]): boolean {
  const [first] = outline;
  if (!first || region.length < 3 || isApart(region, outline)) return false;
  const corner = region[0];
  if (isInside(region, first) || (corner && isInside(outline, corner))) return true;
  return sidesOf(region).some((side) => sidesOf(outline).some((other) => cross(side, other)));
}

type Side = readonly [Spot, Spot];

const sidesOf = (corners: readonly Spot[]): Side[] =>
  corners.map((corner, k) => [corners[(k + corners.length - 1) % corners.length] ?? corner, corner]);

/** Positive where the way from a over b to c turns to the left. */
const turn = (a: Spot, b: Spot, c: Spot): number => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

const cross = ([a, b]: Side, [c, d]: Side): boolean =>
  turn(a, b, c) > 0 !== turn(a, b, d) > 0 && turn(c, d, a) > 0 !== turn(c, d, b) > 0;

/** Whether their boxes are apart. */
function isApart(a: readonly Spot[], b: readonly Spot[]): boolean {
  return ([0, 1] as const).some((axis) => {
    const [from, to] = [a.map((spot) => spot[axis]), b.map((spot) => spot[axis])];
    return Math.max(...from) < Math.min(...to) || Math.max(...to) < Math.min(...from);
  });
}
