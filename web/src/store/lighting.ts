// Hulls that are pointed out while the pointer is over what is about them.
import type { AssetView } from "../wire";
import { setHighlight, useDesk } from "./desk";
import { useProject } from "./project";
import { ownPositions } from "./stepWords";

const WHAT = "step";

/** Points out hulls of an asset by name, and on the other assets what the rule in a place (from 0) selects there. */
export function light(view: AssetView, names: readonly string[], place: number | null = null): void {
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
export function unlight(): void {
  if (useDesk.getState().highlight?.what === WHAT) setHighlight(null);
}
