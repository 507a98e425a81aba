// Selecting hulls that look like the selected ones, in what is shown or in all assets of the family; asked again, more.
import { create } from "zustand";
import { api } from "../server/api";
import { shownAssets } from "./family";
import { type HullPlace, notePositions, sheetName } from "./hullPlaces";
import { ownHulls } from "./labels";
import { useProject } from "./project";
import { notify } from "./toasts";
import { countText } from "./words";
import { allSelected, selectPlaces, useWorkspace } from "./workspace";

export type Where = "here" | "everywhere";

interface SimilarState {
  /** What was found last, as long as it is selected as it is: whether the same key takes more. */
  readonly last: { where: Where; origin: readonly HullPlace[]; found: string; step: number; more: boolean } | null;
  readonly searching: boolean;
}

export const useSimilar = create<SimilarState>()(() => ({ last: null, searching: false }));

/** Selects what looks like the selection; where that was found by this, what looks less like what one began with. */
export async function selectSimilar(where: Where): Promise<void> {
  const { last, searching } = useSimilar.getState();
  const selected = ownSelected();
  if (searching || !selected.length) return;
  const isAgain = last?.where === where && last.found === keyOf(selected);
  if (isAgain && !last.more) return notify("No hull that looks like these is left; Ctrl+click adds others.");
  const origin = isAgain ? last.origin : selected;
  useSimilar.setState({ searching: true });
  try {
    const assets = where === "everywhere" ? [...shownAssets()] : null;
    const found = await api.similar({ hulls: [...origin], assets, step: isAgain ? last.step + 1 : 0 });
    if (keyOf(ownSelected()) !== keyOf(selected)) return;
    for (const { asset, hulls, positions } of found.found) notePositions(asset, hulls.map((hull, k) => [hull, positions[k] ?? 0]));
    const places = found.found.flatMap(({ asset, hulls }) => hulls.map((hull) => ({ asset, hull }))).filter(isInSight);
    const all = unite(selected, places);
    selectPlaces(all);
    useSimilar.setState({ last: { where, origin, found: keyOf(all), step: found.step, more: found.more } });
    if (all.length === selected.length) notify(`No other hull looks like ${selected.length === 1 ? "it" : "these"}.`);
    if (found.unread.length) notify(`${countText(found.unread.length, "asset")} could not be looked in: ${found.unread[0]}`);
    const { passed_over: over } = found;
    if (over) notify(`${countText(over, "asset")} ${over === 1 ? "was" : "were"} not looked in, as there are too many: filter the family to look in others.`);
  } finally {
    useSimilar.setState({ searching: false });
  }
}

/** The selected hulls that the assets have as they come. */
function ownSelected(): HullPlace[] {
  const { sheet, selection } = useWorkspace.getState();
  const own = new Set(sheet.length ? [] : ownHulls(selection));
  const { asset } = useWorkspace.getState();
  return allSelected().filter((place) => sheet.length > 0 || place.asset !== asset || own.has(place.hull));
}

function isInSight({ asset, hull }: HullPlace): boolean {
  const { hidden, sheet, asset: open } = useWorkspace.getState();
  return !hidden.has(sheet.length ? sheetName(asset, hull) : asset === open ? hull : "");
}

const textOf = ({ asset, hull }: HullPlace): string => `${asset}\n${hull}`;
const keyOf = (places: readonly HullPlace[]): string => places.map(textOf).sort().join("\n\n");
const unite = (some: readonly HullPlace[], more: readonly HullPlace[]): HullPlace[] => [
  ...new Map([...some, ...more].map((place) => [textOf(place), place])).values(),
];

let prepared: string | null = null;

/** Has the server describe the assets of a project, once, so that the first question is answered at once. */
export function prepareSimilar(): void {
  const { folder } = useProject.getState().project;
  if (!folder || prepared === folder) return;
  prepared = folder;
  api.prepareSimilar().catch(() => (prepared = null));
}
