// Which assets are shown side by side: some that were chosen, those with selected hulls, or the family page by page.
import { neighbour, shownAssets } from "./family";
import { useProject } from "./project";
import { notify } from "./toasts";
import { allSelected, lookFrom, openAsset, openStage, setLayout, showSheet, useWorkspace, type WorkspaceState } from "./workspace";

/** Assets on a sheet where none were chosen, and at most. */
export const PER_SHEET = 8;
export const MOST_ON_SHEET = 24;

const isReadable = (asset: string): boolean => (useProject.getState().cards[asset]?.hulls ?? 0) > 0;

/** Shows some assets side by side in the label stage, as many as there is room for. */
export function openSheet(assets: readonly string[]): void {
  const readable = assets.filter(isReadable);
  if (readable.length > MOST_ON_SHEET) notify(`The first ${MOST_ON_SHEET} of ${readable.length} assets are side by side.`);
  if (useWorkspace.getState().stage !== "label") openStage("label");
  setLayout({ gallery: false });
  // rows go across this side
  if (!useWorkspace.getState().sheet.length) lookFrom("iso");
  showSheet(readable.slice(0, MOST_ON_SHEET));
}

/** Side by side: assets with selected hulls where these are on several, else the page of the family with the open one;
 * back to the open one where that is so already. */
export function toggleSheet(): void {
  const { sheet, asset, elsewhere } = useWorkspace.getState();
  if (sheet.length) return showSheet(asset === null ? [] : [asset]);
  const selected = new Set(allSelected().map((place) => place.asset));
  if (elsewhere.size) return openSheet(shownAssets().filter((one) => selected.has(one) || one === asset));
  openSheet(pageOf(asset));
}

/** The page of the family that an asset is on. */
function pageOf(asset: string | null): string[] {
  const all = shownAssets().filter(isReadable);
  const start = Math.floor(Math.max(0, all.indexOf(asset ?? "")) / PER_SHEET) * PER_SHEET;
  return all.slice(start, start + PER_SHEET);
}

/** Goes to the next asset or the one before; where several are shown, to as many of the next ones. */
export function openBeside(by: 1 | -1): void {
  const { sheet, asset } = useWorkspace.getState();
  if (!sheet.length) {
    const next = neighbour(shownAssets(), useProject.getState().order, asset, by);
    return next === null ? undefined : openAsset(next);
  }
  const all = shownAssets().filter(isReadable);
  const places = sheet.map((one) => all.indexOf(one)).filter((place) => place >= 0);
  const start = by === 1 ? Math.max(...places) + 1 : Math.min(...places) - sheet.length;
  const wrapped = start >= all.length ? 0 : start < 0 ? (places.includes(0) ? Math.max(0, all.length - sheet.length) : 0) : start;
  showSheet(all.slice(wrapped, wrapped + sheet.length));
}

/** Adds an asset to those side by side, or takes it away. */
export function toggleOnSheet(asset: string): void {
  const now = assetsInView(useWorkspace.getState());
  openSheet(now.includes(asset) ? now.filter((one) => one !== asset) : inOrder([...now, asset]));
}

/** Shows all assets of the family from the open one to another side by side. */
export function extendSheet(to: string): void {
  const all = shownAssets();
  const from = all.indexOf(useWorkspace.getState().asset ?? "");
  const [low, high] = [Math.min(from, all.indexOf(to)), Math.max(from, all.indexOf(to))];
  if (low >= 0) openSheet(all.slice(low, high + 1));
}

/** The assets that are side by side, or the one that is open. */
export function assetsInView({ sheet, asset }: Pick<WorkspaceState, "sheet" | "asset">): readonly string[] {
  if (sheet.length) return sheet;
  return asset === null ? [] : [asset];
}

const inOrder = (assets: readonly string[]): string[] => {
  const all = shownAssets();
  return [...assets].sort((a, b) => all.indexOf(a) - all.indexOf(b));
};
