// Which hulls belong to a selection: neighbours, whole components, those with the same label, all others.
import type { Scene } from "./scenes";

export type Selection = ReadonlySet<string>;
/** What of a scene decides it. */
export type Connected = Pick<Scene, "contacts"> & { readonly hulls: readonly { name: string; label: string | null }[] };

/** The hulls that touch each hull. */
export function neighboursOf({ contacts }: Pick<Scene, "contacts">): ReadonlyMap<string, readonly string[]> {
  const out = new Map<string, string[]>();
  const add = (a: string, b: string) => {
    const known = out.get(a);
    if (known) known.push(b);
    else out.set(a, [b]);
  };
  for (const [a, b] of contacts) {
    add(a, b);
    add(b, a);
  }
  return out;
}

/** The selection with all that touches it. */
export function grown(scene: Connected, selection: Selection): Set<string> {
  const beside = neighboursOf(scene);
  return new Set([...selection, ...[...selection].flatMap((name) => beside.get(name) ?? [])]);
}

/** All that hangs together with the selection. */
export function component(scene: Connected, selection: Selection): Set<string> {
  const beside = neighboursOf(scene);
  const out = new Set(selection);
  for (const name of out) for (const next of beside.get(name) ?? []) out.add(next);
  return out;
}

/** All hulls with a label that one of the selected has; without a label counts as alike, too. */
export function alike({ hulls }: Connected, selection: Selection): Set<string> {
  const labels = new Set(hulls.filter((hull) => selection.has(hull.name)).map((hull) => hull.label));
  return new Set(hulls.filter((hull) => labels.has(hull.label)).map((hull) => hull.name));
}

/** All hulls but the selected ones. */
export function inverted({ hulls }: Connected, selection: Selection): Set<string> {
  return new Set(hulls.map((hull) => hull.name).filter((name) => !selection.has(name)));
}
