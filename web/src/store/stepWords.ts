// What steps and previews come to, in words.
import type { EditedHeader, StepView } from "../wire";
import { counted } from "./words";

/** What an action in hand would do: `12 hulls → 1`, `4 hulls go`, `1 hull is added`. */
export function previewWords(selected: number, { made, removed }: Pick<EditedHeader, "made" | "removed">): string {
  if (!made.length && !removed.length) return "Nothing changes";
  if (!made.length) return `${counted(removed.length, "hull")} ${removed.length === 1 ? "goes" : "go"}`;
  if (!removed.length) return `${counted(made.length, "hull")} ${made.length === 1 ? "is" : "are"} added`;
  return `${counted(Math.max(removed.length, selected), "hull")} → ${made.length}`;
}

/** How much a step takes: `4`, `nothing here` or `open`. */
export function amount(step: Pick<StepView, "select"> | undefined): string {
  if (step?.select == null) return "open";
  return step.select.length ? `×${step.select.length}` : "nothing here";
}

/** The text of an action without the label that it gives, and that label. */
export function splitAction(text: string): { action: string; label: string | null } {
  const found = /^(.*?)\s+as\s+(?:"((?:[^"\\]|\\.)*)"|([\p{L}_][\p{L}\p{N}_]*))$/u.exec(text);
  return found ? { action: found[1] ?? text, label: found[2] ?? found[3] ?? null } : { action: text, label: null };
}

/** Positions of an asset's own hulls that names stand for; a made hull stands for the one it is named after. */
export function ownPositions(names: readonly string[], own: readonly { name: string }[]): number[] {
  const place = new Map(own.map((hull, k) => [hull.name, k]));
  const found = names.flatMap((name) => place.get(name) ?? place.get(name.replace(/(?:~\d+)+$/, "")) ?? []);
  return [...new Set(found)];
}
