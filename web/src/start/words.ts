// What the start page says of assets that were found, and of when a project was open.
import { countText, listText } from "../store/words";
import type { AssetsFound, DecomposeOptions } from "../wire";

/** `12 URDF`, and how many of them were looked at where that is not all. */
export function foundText({ kinds, assets, read }: AssetsFound): string {
  return read < assets ? `${kinds}; the first ${read} were looked at` : kinds;
}

/** What making hulls would do, null where there is nothing to decompose. */
export function decomposeText({ assets, read, bare, pieces, seen }: AssetsFound): string | null {
  if (!bare) return null;
  const of = read < assets ? `${bare} of the first ${read}` : `${bare} of ${assets}`;
  const have = bare === 1 ? "has" : "have";
  return (
    `${of} ${have} geometry that is not convex, or no collision geometry: ${countText(pieces, "piece")}. ` +
    (seen ? `${seen === pieces ? "All" : seen} of these ${seen === 1 ? "is" : "are"} only seen now, and would collide. ` : "") +
    "It is done in the background; you can stop it, and undo it. Without it, the project lets you try settings on one asset first."
  );
}

/** Whether parts that are known are decomposed each by itself. */
export const UNITS = [
  { value: "whole", label: "As a whole" },
  { value: "parts", label: "Part by part" },
] as const;

/** What is known of parts, null where it is nothing. */
export function partsText({ divided, parts }: AssetsFound, by: DecomposeOptions["by"]): string | null {
  if (!divided) return null;
  const names = `${countText(divided, "asset")} ${divided === 1 ? "says" : "say"} what ${divided === 1 ? "its" : "their"} parts are (${listText(parts)})`;
  return `${names}: ${by === "parts" ? "no hull crosses from one to another, and hulls are called by them." : "a hull may hold several of them."}`;
}

/** What cannot be read, null where all can. */
export function brokenText({ broken, problem, left_out: isLeftOut }: AssetsFound): string | null {
  if (!broken) return null;
  const count = countText(broken, "asset");
  const what = isLeftOut ? `${count} cannot be read and ${broken === 1 ? "is" : "are"} left out.` : `${count} cannot be read.`;
  const after = isLeftOut ? "" : "The project can be made all the same.";
  return [what, problem?.replace(/\.?$/, "."), after].filter(Boolean).join(" ");
}

const DAY = 86_400_000;

/** When a project was open last, as people say it; now: [ms]. */
export function openedText(opened: string, now: number): string {
  const then = Date.parse(opened);
  if (Number.isNaN(then)) return "";
  const days = startOfDay(now) - startOfDay(then);
  if (days <= 0) return "today";
  if (days < 2 * DAY - DAY / 2) return "yesterday";
  return new Date(then).toLocaleDateString("en", { day: "numeric", month: "long", year: "numeric" });
}

const startOfDay = (time: number) => new Date(time).setHours(0, 0, 0, 0);

/** A folder of another parent that has the last name of a path. */
export function moveInto(parent: string, path: string, name = "project"): string {
  const last = path.split(/[/\\]/).filter(Boolean).at(-1) ?? name;
  return `${parent.replace(/[/\\]$/, "")}/${last}`;
}
