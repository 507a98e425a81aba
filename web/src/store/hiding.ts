// Which hulls are out of sight; what is hidden is not selected.
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
