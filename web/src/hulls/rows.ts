// The rows of the list of hulls: found by a word, in the order of a column.
import type { SceneHull } from "../store/scenes";

type Column = "name" | "label" | "volume" | "shape" | "neighbours";
/** column: null for the order of the file. */
export interface Order {
  readonly column: Column | null;
  readonly down: boolean;
}

export interface Row {
  readonly hull: SceneHull;
  readonly neighbours: number;
}

export const COLUMNS: readonly { column: Column; title: string; hint: string }[] = [
  { column: "name", title: "Hull", hint: "Name" },
  { column: "label", title: "Label", hint: "Label" },
  { column: "volume", title: "Volume", hint: "Volume" },
  { column: "shape", title: "Shape", hint: "Primitive, or number of vertices" },
  { column: "neighbours", title: "Touch", hint: "Number of hulls that touch it" },
];

/** Clicking a head sorts by it, a second time the other way round, a third time not at all. */
export function nextOrder(order: Order, column: Column): Order {
  if (order.column !== column) return { column, down: false };
  return order.down ? { column: null, down: false } : { column, down: true };
}

export function rowsOf(
  hulls: readonly SceneHull[],
  contacts: readonly (readonly [string, string])[],
  search: string,
  order: Order,
): Row[] {
  const counts = new Map<string, number>();
  for (const name of contacts.flat()) counts.set(name, (counts.get(name) ?? 0) + 1);
  const rows = hulls
    .filter((hull) => matchesSearch(search, hull.name, hull.label ?? "", hull.body, hull.primitive ?? ""))
    .map((hull) => ({ hull, neighbours: counts.get(hull.name) ?? 0 }));
  const { column } = order;
  if (column === null) return rows;
  const sign = order.down ? -1 : 1;
  return rows.sort((a, b) => sign * COMPARE[column](a, b));
}

/** Whether each word of a search is in one of some texts. */
export function matchesSearch(search: string, ...texts: string[]): boolean {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  return words.every((word) => texts.some((text) => text.toLowerCase().includes(word)));
}

const names = new Intl.Collator("en", { numeric: true });

const COMPARE: Readonly<Record<Column, (a: Row, b: Row) => number>> = {
  name: ({ hull: a }, { hull: b }) => names.compare(a.name, b.name),
  // those without a label come last
  label: ({ hull: a }, { hull: b }) => names.compare(a.label ?? "\uffff", b.label ?? "\uffff"),
  volume: ({ hull: a }, { hull: b }) => a.volume - b.volume,
  shape: ({ hull: a }, { hull: b }) => names.compare(a.primitive ?? "", b.primitive ?? "") || a.vertices - b.vertices,
  neighbours: (a, b) => a.neighbours - b.neighbours,
};

/** The names between two of a list, both included; only the second where the first is not in it. */
export function namesBetween(listed: readonly string[], from: string | null, to: string): string[] {
  const [a, b] = [from === null ? -1 : listed.indexOf(from), listed.indexOf(to)];
  return a < 0 || b < 0 ? [to] : listed.slice(Math.min(a, b), Math.max(a, b) + 1);
}
