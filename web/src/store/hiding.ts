// Which hulls are out of sight; what is hidden or gone is not selected.
import { useDesk } from "./desk";
import type { Scene } from "./scenes";

export function hide(names: Iterable<string>): void {
  const more = new Set(names);
  useDesk.setState(({ hidden, selection }) => ({
    hidden: new Set([...hidden, ...more]),
    selection: new Set([...selection].filter((name) => !more.has(name))),
    hover: null,
  }));
}

/** Hides all hulls but some. */
export function isolate(scene: Scene, names: ReadonlySet<string>): void {
  const others = scene.hulls.map((hull) => hull.name).filter((name) => !names.has(name));
  useDesk.setState({ hidden: new Set(others), selection: new Set(names) });
}

export function showAll(): void {
  useDesk.setState({ hidden: new Set() });
}

/** Hulls that are no more are neither selected nor hidden. */
export function forgetGone({ asset, hulls, showing }: Scene): void {
  const desk = useDesk.getState();
  // the selection may already be that of a state which is on its way
  if (desk.asset !== asset || JSON.stringify(desk.showing) !== JSON.stringify(showing)) return;
  const there = new Set(hulls.map((hull) => hull.name));
  const left = (names: ReadonlySet<string>) => new Set([...names].filter((name) => there.has(name)));
  const [selection, hidden] = [left(desk.selection), left(desk.hidden)];
  if (selection.size < desk.selection.size || hidden.size < desk.hidden.size) useDesk.setState({ selection, hidden });
}
