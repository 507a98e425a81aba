// What the browser keeps between visits: theme, widths and the view's settings, taken back without trusting it.
import { initialLayout, initialWorkspace, type LayoutState, useLayout, useWorkspace, type WorkspaceState } from "../store/workspace";

type Preferences = Pick<WorkspaceState, "theme" | "unit" | "columns" | "checks"> & {
  view: Pick<WorkspaceState["view"], "colorBy" | "projection" | "ghost" | "wireframe" | "contacts" | "grid" | "opaque">;
  sort: WorkspaceState["filters"]["sort"];
  layout: Pick<LayoutState, "family" | "split" | "thumbnails">;
};

export const WIDTHS = { family: [180, 720], panel: [300, 720] } as const;

/** The words that a setting may be; an engine that is not known any more has no limits. */
const WORDS: Readonly<Record<string, readonly string[]>> = {
  theme: ["system", "light", "dark"],
  unit: ["m", "mm"],
  thumbnails: ["small", "middle", "large"],
  sort: ["name", "hulls", "unlabelled", "unsure", "changed", "findings", "probability"],
  colorBy: ["hull", "label", "body"],
  projection: ["perspective", "orthographic"],
};
const RANGES: Readonly<Record<string, readonly [number, number]>> = { ...WIDTHS, split: [0.15, 0.85] };

function preferencesOf(workspace: WorkspaceState, { family, split, thumbnails }: LayoutState): Preferences {
  const { theme, unit, columns, view, filters, checks } = workspace;
  const { colorBy, projection, ghost, wireframe, contacts, grid, opaque } = view;
  const some = { colorBy, projection, ghost, wireframe, contacts, grid, opaque };
  return { theme, unit, columns, checks, view: some, sort: filters.sort, layout: { family, split, thumbnails } };
}

export const initialPreferences: Preferences = preferencesOf(initialWorkspace, initialLayout);

/** What was kept, wherever it still makes sense; the rest as it is at first. */
export function restore<T extends object>(initial: T, stored: unknown): T {
  if (typeof stored !== "object" || stored === null) return initial;
  const given = new Map(Object.entries(stored));
  const rows = Object.entries(initial).map(([key, was]) => [key, restoreValue(key, was, given.get(key))]);
  return Object.fromEntries(rows) as T;
}

function restoreValue(key: string, was: unknown, now: unknown): unknown {
  if (typeof was === "object" && was !== null) return restore(was, now);
  if (typeof now !== typeof was) return was;
  if (typeof now === "string") return (WORDS[key]?.includes(now) ?? true) ? now : was;
  if (typeof now === "number") return isWithin(key, now) ? now : was;
  return now;
}

function isWithin(key: string, value: number): boolean {
  const [low, high] = RANGES[key] ?? [-Infinity, Infinity];
  return value >= low && value <= high;
}

const KEY = "meshforge.desk";

/** Takes up what was kept, and keeps what changes from now on. */
export function keepPreferences(): void {
  const { theme, unit, columns, checks, view, sort, layout } = restore(initialPreferences, readStored());
  useWorkspace.setState((workspace) => ({
    theme,
    unit,
    columns,
    checks,
    view: { ...workspace.view, ...view },
    filters: { ...workspace.filters, sort },
  }));
  useLayout.setState(layout);
  let written = localStorage.getItem(KEY);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const write = () => {
    const text = JSON.stringify(preferencesOf(useWorkspace.getState(), useLayout.getState()));
    if (text !== written) localStorage.setItem(KEY, (written = text));
  };
  const soon = () => {
    clearTimeout(timer);
    timer = setTimeout(write, 300);
  };
  useWorkspace.subscribe(soon);
  useLayout.subscribe(soon);
  window.addEventListener("pagehide", write);
}

function readStored(): unknown {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? "null");
  } catch {
    return null;
  }
}

/** Gives the page the chosen theme, or that of the system, now and whenever either changes. */
export function followTheme(): void {
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const update = () => {
    const { theme } = useWorkspace.getState();
    document.documentElement.dataset.theme = theme === "system" ? (dark.matches ? "dark" : "light") : theme;
  };
  update();
  useWorkspace.subscribe((now, before) => now.theme !== before.theme && update());
  dark.addEventListener("change", update);
}
