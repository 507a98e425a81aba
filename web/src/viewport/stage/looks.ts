// What the stores say about the looks of the picture: of the hulls on both sides, and of the contact graph.
import type { AssetDrawing } from "../drawing/assetDrawing";
import type { Appearance } from "../drawing/hullLooks";
import { hullsToRemove } from "../drawing/previewHulls";
import type { ThemeColors } from "../drawing/themeColors";
import type { Point } from "../geometry/triangles";
import { tonesOf } from "../../pictures/hullColors";
import { useAlike } from "../../store/alike";
import { usePreview } from "../../store/preview";
import { useProject } from "../../store/project";
import type { Scene } from "../../store/scenes";
import { midpoint } from "../../store/vectors";
import { type Tool, useWorkspace } from "../../store/workspace";
import { useRegion } from "./regionStore";

/** The looks of what is shown, and of the asset as it is in its file beside it. */
export function appearances(scene: Scene, ink: ThemeColors): { shown: Appearance; before: Appearance } {
  const { view, selection, hover, hidden, tool } = useWorkspace.getState();
  const { region } = useRegion.getState();
  const names = scene.hulls.map((hull) => hull.name);
  const going = hullsToRemove(showsPreview(tool) ? usePreview.getState().preview : null, names);
  const lit = new Set([...region, ...highlightedHulls(scene), ...useAlike.getState().others]);
  const tone = tonesOf(scene, view.colorBy, useProject.getState().project.vocabulary);
  const shown = { tone, selection, hover, hidden, lit, going, ink, changed: changedHulls(scene) };
  return { shown, before: { ...shown, going: new Set() } };
}

/** Previews are hidden while hulls are picked for something else. */
export const showsPreview = (tool: Tool): boolean => tool !== "cut" && tool !== "landmark";

/** What was changed where before and after are beside each other. */
function changedHulls({ edit }: Scene): ReadonlySet<string> | null {
  if (!edit || useWorkspace.getState().view.compare === "off") return null;
  const changed = new Set([...edit.made, ...edit.removed]);
  return changed.size ? changed : null;
}

/** The hulls that a rule or an extractor points out on this asset, and what was made of them. */
function highlightedHulls({ asset, view, hulls }: Scene): string[] {
  const places = useWorkspace.getState().highlight?.assets[asset] ?? [];
  const names = new Set(places.map((place) => view.hulls[place]?.name));
  return hulls.filter(({ name, parent }) => names.has(name) || names.has(parent ?? "")).map((hull) => hull.name);
}

const MOST_GAPS = 12;

/** The contact graph of what is shown: dots, lines, and the gaps of near misses that are pointed at. */
export function graphOf(side: AssetDrawing, explode: number) {
  const { selection, hover, hidden } = useWorkspace.getState();
  const isStrong = (name: string) => selection.has(name) || hover === name;
  const at = (name: string): Point | null => {
    const k = side.hulls.places.get(name);
    return k === undefined || hidden.has(name) ? null : side.hulls.middle(k, explode);
  };
  const pairs = pairsOf(side.scene).flatMap(({ a, b, gap }) => {
    const [from, to] = [at(a), at(b)];
    return from && to ? [{ a: from, b: to, gap, touching: gap === null, strong: isStrong(a) || isStrong(b) }] : [];
  });
  const nodes = side.scene.hulls.flatMap(({ name }) => {
    const here = at(name);
    return here ? [{ at: here, strong: isStrong(name) }] : [];
  });
  const gaps = pairs.flatMap(({ a, b, gap, strong }) => (strong && gap !== null ? [{ at: midpoint(a, b), gap }] : []));
  return { nodes, lines: pairs, gaps: gaps.slice(0, MOST_GAPS) };
}

/** Contacts, and near misses between hulls that are as they come; gap: null for a contact. */
function pairsOf(scene: Scene): { a: string; b: string; gap: number | null }[] {
  const made = new Set(scene.edit?.made ?? []);
  const near = scene.view.near_misses.filter(({ a, b }) => !made.has(a) && !made.has(b));
  return [...scene.contacts.map(([a, b]) => ({ a, b, gap: null })), ...near];
}
