// Labels given to hulls, at once in what is shown, one by one or stroke by stroke; and the list of labels.
import type { Card, VocabularyLabel } from "../wire";
import { perform } from "./edits";
import { byAsset, type HullPlace, placeOf } from "./hullPlaces";
import { type Scene, useScenes } from "./scenes";
import { select, useWorkspace } from "./workspace";

/** Gives hulls a label, at once in what is shown, and on disk by one edit; where that fails, what is shown goes back.
 * hulls: names of what is shown with this asset; elsewhere: hulls of assets that are not shown. */
export async function labelHulls(
  asset: string,
  hulls: readonly string[],
  label: string | null,
  quiet = false,
  elsewhere: readonly HullPlace[] = [],
): Promise<boolean> {
  const before = useScenes.getState().scene;
  if (before?.asset === asset) useScenes.setState({ scene: withLabel(before, hulls, label) });
  const shown = useScenes.getState().scene;
  const places = [...hulls.map((hull) => (before?.parts ? placeOf(hull) : undefined) ?? { asset, hull }), ...elsewhere];
  const done = await perform({ kind: "label", hulls: Object.fromEntries(byAsset(places)), label }, { quiet });
  if (!done && useScenes.getState().scene === shown) useScenes.setState({ scene: before });
  return done;
}

/** The label of a hull that is none of the parts. */
export const NO_PART = "no part";

/** A scene in which some hulls have a label that a person gave. */
function withLabel(scene: Scene, names: readonly string[], label: string | null): Scene {
  const given = new Set(names);
  const shown = label === NO_PART ? null : label;
  const now = label === null ? ({ confidence: null, source: null, look: null } as const) : ({ confidence: 1, source: "user", look: "given" } as const);
  const hulls = scene.hulls.map((hull) => (given.has(hull.name) ? { ...hull, label: shown, ...now } : hull));
  return { ...scene, hulls };
}

interface Stroke {
  readonly asset: string;
  readonly brush: string;
  readonly hulls: Set<string>;
}
let stroke: Stroke | null = null;

/** Paints hulls with the armed label, up to the end of the stroke. */
export function paint(names: readonly string[]): void {
  const { asset, brush } = useWorkspace.getState();
  const hulls = ownHulls(new Set(names));
  if (asset === null || brush === null || !hulls.length) return;
  if (stroke && (stroke.asset !== asset || stroke.brush !== brush)) endStroke();
  stroke ??= { asset, brush, hulls: new Set() };
  for (const hull of hulls) stroke.hulls.add(hull);
  const { scene } = useScenes.getState();
  if (scene?.asset === asset) useScenes.setState({ scene: withLabel(scene, hulls, brush || null) });
}

/** A stroke is over: what was painted since the last one is one edit. */
export function endStroke(): void {
  if (stroke) void labelHulls(stroke.asset, [...stroke.hulls], stroke.brush || null, true);
  stroke = null;
}

/** Selects every hull of the asset with a label, or without one. */
export function selectLabel(label: string | null): void {
  const { scene } = useScenes.getState();
  select(scene?.hulls.filter((hull) => hull.label === label).map((hull) => hull.name) ?? []);
}

/** Hulls that the asset has as it comes; only those have labels of their own. */
export function ownHulls(names: ReadonlySet<string>): string[] {
  const { scene } = useScenes.getState();
  return scene?.view.hulls.map((hull) => hull.name).filter((name) => names.has(name)) ?? [];
}

/** How many hulls have each label, by its place in the vocabulary; null while assets are still to be read. */
export function countLabels(cards: Readonly<Record<string, Card>>): ReadonlyMap<number, number> | null {
  const all = Object.values(cards);
  if (all.some((card) => card.hulls === null && card.error === null)) return null;
  const counts = new Map<number, number>();
  for (const place of all.flatMap((card) => card.labels)) counts.set(place, (counts.get(place) ?? 0) + 1);
  return counts;
}

/** The labels of a vocabulary that no hull has; none as long as assets are being read. */
export function labelsWithoutHull(cards: Readonly<Record<string, Card>>, vocabulary: readonly VocabularyLabel[]): string[] {
  const counts = countLabels(cards);
  return vocabulary.flatMap(({ name, is_class }, place) => (!counts || is_class || counts.has(place) ? [] : [name]));
}

/** The labels with those of a typed list added, which stand between commas; ones already there are left out. */
export function addLabels(labels: readonly string[], typed: string): string[] {
  const words = typed.split(",").map((word) => word.trim().replaceAll(/\s+/g, " "));
  return [...new Set([...labels, ...words.filter(Boolean)])];
}

/** The list with one of its lines at another place. */
export function moveItem<T>(list: readonly T[], from: number, to: number): T[] {
  const rest = list.filter((_, k) => k !== from);
  const place = Math.min(Math.max(to, 0), rest.length);
  return [...rest.slice(0, place), ...list.slice(from, from + 1), ...rest.slice(place)];
}
