// Hulls that are highlighted in the view and the thumbnails, while the pointer is over what is about them.
import type { AssetView, Reach } from "../wire";
import { useProject } from "./project";
import { type Highlight, setHighlight, useWorkspace } from "./workspace";

const WHAT = "step";

/** Points out hulls of an asset by name, and on the other assets what the rule in a place (from 0) selects there. */
export function highlightStep(view: AssetView, names: readonly string[], place: number | null = null): void {
  const { reach } = useProject.getState();
  const others = Object.values(reach).map(
    ({ asset, rules }) => [asset, (place === null ? undefined : rules[place]) ?? []] as const,
  );
  if (!names.length && !others.some(([, hulls]) => hulls.length)) return;
  setHighlight({
    what: WHAT,
    assets: { ...Object.fromEntries(others), [view.asset]: ownPositions(names, view.hulls) },
  });
}

/** Points them out no longer; what others point out stays. */
export function clearStepHighlight(): void {
  if (useWorkspace.getState().highlight?.what === WHAT) setHighlight(null);
}

/** Positions of an asset's own hulls that names stand for; a made hull stands for the one it is named after. */
export function ownPositions(names: readonly string[], own: readonly { name: string }[]): number[] {
  const place = new Map(own.map((hull, k) => [hull.name, k]));
  const found = names.flatMap((name) => place.get(name) ?? place.get(name.replace(/(?:~\d+)+$/, "")) ?? []);
  return [...new Set(found)];
}

/** What a rule (from 1) selects on all assets, for the thumbnails. */
export function highlightOfRule(reach: Readonly<Record<string, Reach>>, rule: number): Highlight {
  const rows = Object.values(reach).flatMap(({ asset, rules }) => {
    const positions = rules[rule - 1];
    return positions ? [[asset, positions] as const] : [];
  });
  return { what: `rule ${rule}`, assets: Object.fromEntries(rows) };
}
