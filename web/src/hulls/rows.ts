// The rows of the list of hulls: found by a word, in the order of a column, below their bodies where there are several.
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

/** A row of the tree, by a key that no other has: a body with its hulls that are found, or a hull. */
export type Line =
  | { readonly key: string; readonly body: string; readonly names: readonly string[]; readonly open: boolean }
  | { readonly key: string; readonly row: Row };

/** The rows below their bodies, in the order of `bodies`; of a body that is in `closed` only itself; the rows alone where all
 * hulls are of one body. */
export function linesOf(rows: readonly Row[], bodies: readonly string[], closed: ReadonlySet<string>): Line[] {
  const lines = (some: readonly Row[]): Line[] => some.map((row) => ({ key: row.hull.name, row }));
  const unique = [...new Set(bodies)];
  if (unique.length < 2) return lines(rows);
  return unique.flatMap((body) => {
    const own = rows.filter(({ hull }) => hull.body === body);
    if (!own.length) return [];
    const open = !closed.has(body);
    return [{ key: `body ${body}/`, body, names: own.map(({ hull }) => hull.name), open }, ...(open ? lines(own) : [])];
  });
}

/** The hulls that a row stands for. */
export const namesOf = (line: Line): readonly string[] => ("row" in line ? [line.key] : line.names);

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

/** The keys between two of a list, both included; only the second where the first is not in it. */
export function keysBetween(listed: readonly string[], from: string | null, to: string): string[] {
  const [a, b] = [from === null ? -1 : listed.indexOf(from), listed.indexOf(to)];
  return a < 0 || b < 0 ? [to] : listed.slice(Math.min(a, b), Math.max(a, b) + 1);
}
