// Labels given to hulls: of the selection, stroke by stroke, and along the queue of unsure ones.
import { openAsset, openStage, select, setBrush, useDesk } from "./desk";
import { perform } from "./edits";
import { useProject } from "./project";
import { details, type Scene, useScenes } from "./scenes";
import { complainedOf } from "./toasts";
import { nextUnsure } from "./unsure";

/** How long a stroke may pause and still be one edit [ms]. */
const PAUSE = 150;

/** Labels the selected hulls, or, where none is, arms the label so that clicks paint it; null takes labels away. */
export function applyLabel(label: string | null): void {
  const { asset, selection, brush } = useDesk.getState();
  const hulls = ownHulls(selection);
  const paint = label ?? "";
  if (asset === null || !hulls.length) return setBrush(brush === paint ? null : paint);
  setBrush(null);
  void labelHulls(asset, hulls, label);
}

/** Gives hulls a label, at once in what is shown, and on disk; where that fails, what is shown goes back. */
export async function labelHulls(
  asset: string,
  hulls: readonly string[],
  label: string | null,
  quiet = false,
): Promise<boolean> {
  const before = useScenes.getState().scene;
  if (before?.asset === asset) useScenes.setState({ scene: relabelled(before, hulls, label) });
  const shown = useScenes.getState().scene;
  const done = await perform({ kind: "label", asset, hulls: [...hulls], label }, { quiet });
  if (!done && useScenes.getState().scene === shown) useScenes.setState({ scene: before });
  return done;
}

/** A scene in which some hulls have a label that a person gave. */
export function relabelled(scene: Scene, names: readonly string[], label: string | null): Scene {
  const given = new Set(names);
  const sure = label === null ? null : 1;
  const hulls = scene.hulls.map((hull) =>
    given.has(hull.name) ? { ...hull, label, confidence: sure, source: label === null ? null : "user" } : hull,
  );
  return { ...scene, hulls };
}

interface Stroke {
  readonly asset: string;
  readonly brush: string;
  readonly hulls: Set<string>;
}
let stroke: Stroke | null = null;
let lifting: ReturnType<typeof setTimeout> | undefined;

/** Paints hulls with the armed label; those of one stroke become one edit. */
export function paint(names: readonly string[]): void {
  const { asset, brush } = useDesk.getState();
  const hulls = ownHulls(new Set(names));
  if (asset === null || brush === null || !hulls.length) return;
  if (stroke && (stroke.asset !== asset || stroke.brush !== brush)) lift();
  stroke ??= { asset, brush, hulls: new Set() };
  for (const hull of hulls) stroke.hulls.add(hull);
  const { scene } = useScenes.getState();
  if (scene?.asset === asset) useScenes.setState({ scene: relabelled(scene, hulls, brush || null) });
  clearTimeout(lifting);
  lifting = setTimeout(lift, PAUSE);
}

function lift(): void {
  if (stroke) void labelHulls(stroke.asset, [...stroke.hulls], stroke.brush || null, true);
  stroke = null;
}

/** The labels of the selected hulls are right: the person vouches for them; then goes on to the next unsure one. */
export async function confirmLabels(): Promise<void> {
  const { asset, selection } = useDesk.getState();
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset) return;
  const hulls = scene.hulls.filter((hull) => selection.has(hull.name) && hull.label !== null);
  for (const label of new Set(hulls.map((hull) => hull.label))) {
    await labelHulls(
      asset,
      hulls.filter((hull) => hull.label === label).map((hull) => hull.name),
      label,
    );
  }
  if (hulls.length) await goToUnsure();
}

/** Opens the asset of the next unsure hull, and selects the hull. */
export async function goToUnsure(): Promise<void> {
  const { asset, selection } = useDesk.getState();
  const { cards, order } = useProject.getState();
  const { scene } = useScenes.getState();
  const at = scene?.asset === asset ? (scene?.view.hulls.findLastIndex((hull) => selection.has(hull.name)) ?? -1) : -1;
  const next = nextUnsure(cards, order, asset === null ? null : { asset, position: at });
  if (!next) return;
  openStage("label");
  openAsset(next.asset);
  try {
    const { view } = await details(next.asset);
    const hull = view.hulls[next.position];
    if (hull && useDesk.getState().asset === next.asset) select([hull.name]);
  } catch (error) {
    complainedOf(error);
  }
}

/** Selects every hull of the asset with a label, or without one. */
export function selectLabel(label: string | null): void {
  const { scene } = useScenes.getState();
  select(scene?.hulls.filter((hull) => hull.label === label).map((hull) => hull.name) ?? []);
}

/** Hulls that the asset has as it comes; only those have labels of their own. */
function ownHulls(names: ReadonlySet<string>): string[] {
  const { scene } = useScenes.getState();
  return scene?.view.hulls.map((hull) => hull.name).filter((name) => names.has(name)) ?? [];
}
