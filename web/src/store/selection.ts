// Which hulls a selection grows to, and which are hidden.
import { groupBy } from "./once";
import type { Scene } from "./scenes";
import { useWorkspace } from "./workspace";

export type Selection = ReadonlySet<string>;
/** What of a scene decides it. */
export type Connected = Pick<Scene, "contacts"> & { readonly hulls: readonly { name: string; label: string | null; body: string }[] };

/** The hulls that touch each hull. */
export const neighboursOf = ({ contacts }: Pick<Scene, "contacts">): ReadonlyMap<string, readonly string[]> =>
  groupBy([...contacts, ...contacts.map(([a, b]) => [b, a] as const)], ([a]) => a, ([, b]) => b);

/** The selection with all that touches it. */
export function withNeighbours(scene: Connected, selection: Selection): Set<string> {
  const beside = neighboursOf(scene);
  return new Set([...selection, ...[...selection].flatMap((name) => beside.get(name) ?? [])]);
}

/** All that hangs together with the selection. */
export function withConnected(scene: Connected, selection: Selection): Set<string> {
  const beside = neighboursOf(scene);
  const out = new Set(selection);
  for (const name of out) for (const next of beside.get(name) ?? []) out.add(next);
  return out;
}

/** All hulls whose label, or body, one of the selected has, too; without a label counts as alike. */
export function withSame(what: "label" | "body", { hulls }: Connected, selection: Selection): Set<string> {
  const wanted = new Set(hulls.filter((hull) => selection.has(hull.name)).map((hull) => hull[what]));
  return new Set(hulls.filter((hull) => wanted.has(hull[what])).map((hull) => hull.name));
}

/** All hulls but the selected ones. */
export function invert({ hulls }: Connected, selection: Selection): Set<string> {
  return new Set(hulls.map((hull) => hull.name).filter((name) => !selection.has(name)));
}

/** Which hulls are out of sight; what is hidden or gone is not selected. */
export function hide(names: Iterable<string>): void {
  const more = new Set(names);
  useWorkspace.setState(({ hidden, selection }) => ({
    hidden: new Set([...hidden, ...more]),
    selection: new Set([...selection].filter((name) => !more.has(name))),
    hover: null,
  }));
}

/** Hides all hulls but some. */
export function isolate(scene: Scene, names: ReadonlySet<string>): void {
  const others = scene.hulls.map((hull) => hull.name).filter((name) => !names.has(name));
  useWorkspace.setState({ hidden: new Set(others), selection: new Set(names) });
}

export const showAll = (): void => useWorkspace.setState({ hidden: new Set() });

/** Hulls that are no more are neither selected nor hidden. */
export function forgetMissing({ asset, hulls, showing, parts }: Scene): void {
  const workspace = useWorkspace.getState();
  // the selection may already be that of a state which is on its way
  if (workspace.asset !== asset || JSON.stringify(workspace.showing) !== JSON.stringify(showing)) return;
  if (workspace.sheet.length > 0 !== (parts !== undefined)) return;
  const there = new Set(hulls.map((hull) => hull.name));
  const left = (names: ReadonlySet<string>) => new Set([...names].filter((name) => there.has(name)));
  const [selection, hidden] = [left(workspace.selection), left(workspace.hidden)];
  if (selection.size < workspace.selection.size || hidden.size < workspace.hidden.size) useWorkspace.setState({ selection, hidden });
}
