// What the browser keeps between visits, and how it is taken back without trusting it.
import { initialDesk, type DeskState } from "./desk";
import { initialLayout, type LayoutState } from "./layout";

export type Kept = Pick<DeskState, "theme" | "columns" | "checks"> & {
  view: Pick<DeskState["view"], "colorBy" | "projection" | "ghost" | "wireframe" | "contacts" | "grid" | "opaque">;
  sort: DeskState["filters"]["sort"];
  layout: Pick<LayoutState, "family" | "split">;
};

export const WIDTHS = { family: [180, 720], panel: [300, 720] } as const;

/** The words that a setting may be; an engine that is not known any more has no limits. */
const WORDS: Readonly<Record<string, readonly string[]>> = {
  theme: ["system", "light", "dark"],
  sort: ["name", "hulls", "unlabelled", "unsure", "changed", "findings"],
  colorBy: ["hull", "label", "confidence", "body"],
  projection: ["perspective", "orthographic"],
};
const RANGES: Readonly<Record<string, readonly [number, number]>> = { ...WIDTHS, split: [0.15, 0.85] };

export function keptOf({ theme, columns, view, filters, checks }: DeskState, { family, split }: LayoutState): Kept {
  const { colorBy, projection, ghost, wireframe, contacts, grid, opaque } = view;
  const some = { colorBy, projection, ghost, wireframe, contacts, grid, opaque };
  return { theme, columns, checks, view: some, sort: filters.sort, layout: { family, split } };
}

export const initialKept: Kept = keptOf(initialDesk, initialLayout);

/** What was kept, wherever it still makes sense; the rest as it is at first. */
export function restored<T extends object>(initial: T, stored: unknown): T {
  if (typeof stored !== "object" || stored === null) return initial;
  const given = new Map(Object.entries(stored));
  const rows = Object.entries(initial).map(([key, was]) => [key, taken(key, was, given.get(key))]);
  return Object.fromEntries(rows) as T;
}

function taken(key: string, was: unknown, now: unknown): unknown {
  if (typeof was === "object" && was !== null) return restored(was, now);
  if (typeof now !== typeof was) return was;
  if (typeof now === "string") return (WORDS[key]?.includes(now) ?? true) ? now : was;
  if (typeof now === "number") return within(key, now) ? now : was;
  return now;
}

function within(key: string, value: number): boolean {
  const [low, high] = RANGES[key] ?? [-Infinity, Infinity];
  return value >= low && value <= high;
}
