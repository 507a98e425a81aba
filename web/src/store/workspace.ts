// What the person looks at and has in hand: asset, stage, selection, view, and how the window is divided; knows neither
// DOM nor three.js.
import { create } from "zustand";
import type { ActionCall, NextStep } from "../wire";
import { byAsset, type HullPlace, placeOf, sheetName } from "./hullPlaces";
import type { LengthUnit } from "./units";

export const STAGES = ["label", "demonstrate", "learn", "review"] as const;
export type StageName = (typeof STAGES)[number];

/** The stage in which each kind of step is done. */
export const STAGE_OF: Readonly<Record<NextStep["kind"], StageName>> = {
  wait: "label",
  decompose: "label",
  "label-all": "label",
  label: "label",
  "check-labels": "label",
  demonstrate: "demonstrate",
  learn: "learn",
  answer: "learn",
  "fix-program": "learn",
  apply: "review",
  review: "review",
  correct: "review",
  export: "review",
};

/** Which state of the asset is shown: original, after some of its own steps, or edited. */
export type Showing =
  | { kind: "source" }
  | { kind: "steps"; steps: number }
  /** Hulls that a job tried on it. */
  | { kind: "hulls"; job: string }
  | { kind: "result"; of: "program" | "output" };

export type ColorBy = "hull" | "label" | "body";
export type Tool = "select" | "box" | "lasso" | "cut" | "landmark" | "ruler";
export type StandardView = "front" | "back" | "right" | "left" | "top" | "bottom" | "iso";
export type Compare = "off" | "slider" | "side";

/** What the thumbnails point out: positions of the assets' own hulls. */
export interface Highlight {
  what: string;
  assets: Readonly<Record<string, readonly number[]>>;
}

/** The action that is being put together in the demonstrate stage. */
export interface Draft extends Required<ActionCall> {
  /** The place of the step that is being changed, null for a new one. */
  editing: number | null;
}

export interface ViewSettings {
  colorBy: ColorBy;
  projection: "perspective" | "orthographic";
  /** Whether assets of very different sizes are drawn in one size where they are side by side. */
  oneSize: boolean;
  ghost: boolean;
  wireframe: boolean;
  contacts: boolean;
  grid: boolean;
  opaque: boolean;
  /** 0 as it is, 1 far apart. */
  explode: number;
  compare: Compare;
  /** Where the before/after line is, a share of the width. */
  divider: number;
}

export interface Filters {
  search: string;
  only: readonly FilterName[];
  sort: "name" | "hulls" | "unlabelled" | "unsure" | "changed" | "findings" | "probability";
  /** Whether a person chose the order. */
  chosen?: boolean;
}
export type FilterName =
  | "unlabelled"
  | "unsure"
  | "demonstrated"
  | "edited"
  | "accepted"
  | "wrong"
  | "flagged"
  | "failed"
  | "stale"
  | "findings"
  | "needs review";

interface CheckSettings {
  /** Whether results are measured as they are looked at. */
  open: boolean;
  /** The engine whose limits count, empty for none. */
  engine: string;
}

export interface WorkspaceState {
  asset: string | null;
  stage: StageName;
  showing: Showing;
  /** What is to be shown of this asset in place of what its stage usually shows. */
  asked: Showing | null;
  /** Assets that are shown side by side to be labelled, the open one among them; empty where that is alone. */
  sheet: readonly string[];
  /** Names of hulls of what is shown. */
  selection: ReadonlySet<string>;
  /** What else is selected, on assets that are not shown: names of their hulls. */
  elsewhere: ReadonlyMap<string, readonly string[]>;
  hover: string | null;
  hidden: ReadonlySet<string>;
  tool: Tool;
  /** Whether box, lasso and clicks in one place also take hulls behind others. */
  through: boolean;
  /** The label that clicks paint, empty for taking labels away, null for plain selecting. */
  brush: string | null;
  /** Hulls that were clicked as landmarks of the orientation: where the direction starts, then where it ends. */
  landmarks: readonly string[];
  draft: Draft | null;
  highlight: Highlight | null;
  view: ViewSettings;
  filters: Filters;
  checks: CheckSettings;
  theme: "system" | "light" | "dark";
  /** Of all lengths that are shown. */
  unit: LengthUnit;
  /** Widths of the left and right column [px]. */
  columns: { family: number; panel: number };
  overlay: "none" | "help" | "palette" | "history";
  /** Counts up when the camera is asked to move: to a standard view, to fit all, to frame the selection, or to look at it from
   * where the rest of the asset is seen, too. */
  cameraOrder: { count: number; to: StandardView | "fit" | "frame" | "near" };
}

const NOWHERE: WorkspaceState["elsewhere"] = new Map();

export const initialWorkspace: WorkspaceState = {
  asset: null,
  stage: "label",
  showing: { kind: "source" },
  asked: null,
  sheet: [],
  selection: new Set(),
  elsewhere: NOWHERE,
  hover: null,
  hidden: new Set(),
  tool: "select",
  through: false,
  brush: null,
  landmarks: [],
  draft: null,
  highlight: null,
  view: {
    colorBy: "label",
    projection: "perspective",
    oneSize: false,
    ghost: false,
    wireframe: false,
    contacts: false,
    grid: true,
    opaque: true,
    explode: 0,
    compare: "off",
    divider: 0.5,
  },
  filters: { search: "", only: [], sort: "name" },
  checks: { open: false, engine: "" },
  theme: "system",
  unit: "m",
  columns: { family: 280, panel: 360 },
  overlay: "none",
  cameraOrder: { count: 0, to: "iso" },
};

export const useWorkspace = create<WorkspaceState>()(() => initialWorkspace);

const set = useWorkspace.setState;

/** Goes to an asset; selection, hover and what is hidden belong to one asset and are left behind, unless hulls of several
 * assets are selected. */
export function openAsset(asset: string | null): void {
  const before = useWorkspace.getState();
  if (before.asset === asset && !before.sheet.length) return;
  const kept = before.elsewhere.size && asset !== null ? splitSelection(allSelected(), [asset], false) : LEFT;
  set({ asset, ...kept, sheet: [], asked: null, hover: null, hidden: new Set(), draft: null, landmarks: [], tool: "select" });
}

const LEFT: Pick<WorkspaceState, "selection" | "elsewhere"> = { selection: new Set(), elsewhere: NOWHERE };

/** Shows assets side by side, the open one among them; the first one is opened where it is not. The selection stays. */
export function showSheet(assets: readonly string[]): void {
  const { asset } = useWorkspace.getState();
  const open = asset !== null && assets.includes(asset) ? asset : (assets[0] ?? asset);
  const sheet = assets.length > 1 ? assets : [];
  const shown = sheet.length ? sheet : open === null ? [] : [open];
  const kept = splitSelection(allSelected(), shown, sheet.length > 0);
  set({ asset: open, sheet, ...kept, asked: null, hover: null, hidden: new Set() });
}

/** Every selected hull, on assets that are shown and on others. */
export function allSelected(): HullPlace[] {
  const { asset, sheet, selection, elsewhere } = useWorkspace.getState();
  const ofShown = [...selection].flatMap((name) => (sheet.length ? (placeOf(name) ?? []) : asset === null ? [] : { asset, hull: name }));
  return [...ofShown, ...[...elsewhere].flatMap(([other, hulls]) => hulls.map((hull) => ({ asset: other, hull })))];
}

/** Selects hulls of any assets. */
export function selectPlaces(places: readonly HullPlace[]): void {
  const { asset, sheet } = useWorkspace.getState();
  set(splitSelection(places, sheet.length ? sheet : asset === null ? [] : [asset], sheet.length > 0));
}

/** What is selected on the assets that are shown, and elsewhere. */
function splitSelection(places: readonly HullPlace[], shown: readonly string[], isSheet: boolean): Pick<WorkspaceState, "selection" | "elsewhere"> {
  const [here, there] = [true, false].map((on) => places.filter(({ asset }) => shown.includes(asset) === on));
  const names = (here ?? []).map(({ asset, hull }) => (isSheet ? sheetName(asset, hull) : hull));
  return { selection: new Set(names), elsewhere: there?.length ? byAsset(there) : NOWHERE };
}

/** Goes to an asset in a state, and selects hulls there; it stays in that state until another stage or asset is opened. */
export function visit(asset: string, showing: Showing, names: Iterable<string> = []): void {
  openAsset(asset);
  set({ asked: showing, showing, selection: new Set(names), elsewhere: NOWHERE });
}

export function openStage(stage: StageName): void {
  if (useWorkspace.getState().stage === stage) return;
  if (stage === "review") sortForReview();
  set({ stage, asked: null, sheet: [], selection: new Set(), elsewhere: NOWHERE, draft: null, brush: null, landmarks: [], tool: "select" });
}

/** In review, the least sure come first, unless the person has chosen an order. */
function sortForReview(): void {
  const { filters } = useWorkspace.getState();
  if (filters.sort === "name" && !filters.chosen) setFilters({ sort: "probability" });
}

export const show = (showing: Showing): void => set({ showing });

export const select = (names: Iterable<string>): void => set({ selection: new Set(names), elsewhere: NOWHERE });

/** Selects hulls of what is shown; what is selected elsewhere stays. */
export const selectHere = (names: Iterable<string>): void => set({ selection: new Set(names) });

/** Adds, takes away or replaces, as shift- and ctrl-clicks do. */
export function selectMore(names: Iterable<string>, how: "replace" | "add" | "toggle" | "subtract"): void {
  const before = useWorkspace.getState().selection;
  if (how === "replace") return select(names);
  const after = new Set(before);
  for (const name of names) {
    if (how === "subtract" || (how === "toggle" && before.has(name))) after.delete(name);
    else after.add(name);
  }
  selectHere(after);
}

/** Chooses a tool; landmarks are clicked anew. */
export const setTool = (tool: Tool): void => set({ tool, landmarks: [] });

export const setThrough = (through: boolean): void => set({ through });

/** Arms a label, so that clicks paint it, and nothing is selected; null puts the brush down. */
export const setBrush = (brush: string | null): void => set(brush === null ? { brush } : { brush, ...LEFT });

// who selects paints no longer, so that a digit and a click have one meaning
useWorkspace.subscribe(({ brush, selection, elsewhere }) => brush !== null && (selection.size || elsewhere.size) && setBrush(null));

export const setDraft = (draft: Draft | null): void => set({ draft });

export function hover(name: string | null): void {
  if (useWorkspace.getState().hover !== name) set({ hover: name });
}

export function setView(change: Partial<ViewSettings>): void {
  set((state) => ({ view: { ...state.view, ...change } }));
}

export function setFilters(change: Partial<Filters>): void {
  set((state) => ({ filters: { ...state.filters, ...change } }));
}

export function setChecks(change: Partial<CheckSettings>): void {
  set((state) => ({ checks: { ...state.checks, ...change } }));
}

export function lookFrom(to: WorkspaceState["cameraOrder"]["to"]): void {
  set((state) => ({ cameraOrder: { count: state.cameraOrder.count + 1, to } }));
}

/** The hulls that belong to a highlight's thumbnails, or none. */
export const setHighlight = (highlight: Highlight | null): void => set({ highlight });

/** The unit of lengths that the person chose. */
export const useUnit = (): LengthUnit => useWorkspace((workspace) => workspace.unit);

export const setUnit = (unit: LengthUnit): void => set({ unit });

export interface LayoutState {
  /** Whether the family's column is there. */
  family: boolean;
  /** Whether the family fills the centre. */
  gallery: boolean;
  /** The share of the right column that the panel has above the list of hulls. */
  split: number;
  /** How large the pictures of the family are. */
  thumbnails: "small" | "middle" | "large";
}

/** How the window is divided; knows no DOM. (Widths of the columns are on the workspace.) */
export const initialLayout: LayoutState = { family: true, gallery: false, split: 0.68, thumbnails: "middle" };

export const useLayout = create<LayoutState>()(() => initialLayout);

export const setLayout = (change: Partial<LayoutState>): void => useLayout.setState(change);

// what one looks at, paints or demonstrates on is in the view, which the family in the centre would hide
useWorkspace.subscribe((now, before) => {
  const isInView = now.asked ?? now.brush ?? (now.stage === "demonstrate" || null);
  if (isInView && (now.asked !== before.asked || now.brush !== before.brush || now.stage !== before.stage)) setLayout({ gallery: false });
});
