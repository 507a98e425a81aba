// The colour of each hull under the rule that the person chose.
import type { ColorBy } from "../../store/desk";
import type { Scene } from "../../store/scenes";
import type { HullView, VocabularyLabel } from "../../wire";
import { distinctPlaces, PALETTE } from "./distinct";

export { PALETTE };

/** A colour, null for the grey of what has none; hatched: it is not sure. */
export interface Tone {
  readonly color: string | null;
  readonly hatched: boolean;
}

export const UNSURE = 0.5;

/** The colours of a scene's hulls. */
export function tones(scene: Scene, by: ColorBy, vocabulary: readonly VocabularyLabel[]): (hull: HullView) => Tone {
  const places = distinctPlaces(scene);
  const labels = new Map(vocabulary.map(({ name, color }) => [name, color]));
  const plain = (color: string | null): Tone => ({ color, hatched: false });
  switch (by) {
    case "hull":
      return ({ name }) => plain(PALETTE[places.get(name) ?? 0] ?? null);
    case "body":
      return ({ body }) => plain(PALETTE[scene.view.bodies.indexOf(body) % PALETTE.length] ?? null);
    case "confidence":
      return ({ label, confidence }) => plain(label === null ? null : confidenceColor(confidence ?? 1));
    case "label":
      return (hull) => ({ color: labels.get(hull.label ?? "") ?? null, hatched: isUnsure(hull) });
  }
}

export const isUnsure = ({ label, confidence }: HullView): boolean => label !== null && (confidence ?? 1) < UNSURE;

/** From not sure at all to certain; both ends differ in lightness and hue, also for the colour-blind. */
export const CONFIDENCE: readonly string[] = ["#b5470b", "#e58b3a", "#f2d9a4", "#86b4d6", "#2a6fad"];

export function confidenceColor(confidence: number): string {
  const at = Math.min(1, Math.max(0, confidence)) * (CONFIDENCE.length - 1);
  const low = Math.min(CONFIDENCE.length - 2, Math.floor(at));
  return mixed(CONFIDENCE[low] ?? "", CONFIDENCE[low + 1] ?? "", at - low);
}

function mixed(a: string, b: string, share: number): string {
  const part = (hex: string, k: number) => parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16);
  const parts = [0, 1, 2].map((k) => Math.round(part(a, k) + (part(b, k) - part(a, k)) * share));
  return `#${parts.map((value) => value.toString(16).padStart(2, "0")).join("")}`;
}
