// What the stores say about the looks of both sides.
import { type Tool, useDesk } from "../../store/desk";
import { usePreview } from "../../store/preview";
import { useProject } from "../../store/project";
import { relabelledOn } from "../../store/relabelled";
import type { Scene } from "../../store/scenes";
import { tones } from "../colors/palette";
import type { Ink } from "../drawing/ink";
import type { Appearance } from "../drawing/looks";
import { goingOf } from "../drawing/made";
import { usePointing } from "./pointing";

/** The looks of what is shown, and of the asset as it comes beside it. */
export function appearances(scene: Scene, ink: Ink): { shown: Appearance; before: Appearance } {
  const { view, selection, hover, hidden, tool } = useDesk.getState();
  const { region } = usePointing.getState();
  const names = scene.hulls.map((hull) => hull.name);
  const going = goingOf(showsPreview(tool) ? usePreview.getState().preview : null, names);
  const lit = new Set([...region, ...highlighted(scene)]);
  const tone = tones(scene, view.colorBy, useProject.getState().project.vocabulary);
  const shown = { tone, selection, hover, hidden, lit, going, ink, changed: compared(scene) };
  return { shown, before: { ...shown, going: new Set() } };
}

/** Previews stand back while hulls are picked for something else. */
export const showsPreview = (tool: Tool): boolean => tool !== "cut" && tool !== "landmark";

/** What was changed: in its label by the last edit of all labels, or where before and after are beside each other. */
function compared(scene: Scene): ReadonlySet<string> | null {
  const { stage, view } = useDesk.getState();
  const { edit } = scene;
  if (!edit) return stage === "label" ? relabelled(scene) : null;
  if (view.compare === "off") return null;
  const changed = new Set([...edit.made, ...edit.removed]);
  return changed.size ? changed : null;
}

/** The hulls that got another label; null where these are all, so that none stands out. */
function relabelled({ asset, hulls }: Scene): ReadonlySet<string> | null {
  const found = relabelledOn(asset);
  const places = found ? [...found.new, ...found.changed] : [];
  return places.length && places.length < hulls.length ? new Set(places.flatMap((k) => hulls[k]?.name ?? [])) : null;
}

/** The hulls that a rule or an extractor points out on this asset, and what was made of them. */
function highlighted({ asset, view, hulls }: Scene): string[] {
  const places = useDesk.getState().highlight?.assets[asset] ?? [];
  const names = new Set(places.map((place) => view.hulls[place]?.name));
  return hulls.filter(({ name, parent }) => names.has(name) || names.has(parent ?? "")).map((hull) => hull.name);
}
