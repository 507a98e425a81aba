// Counts and sizes as people write them.

/** `1 hull`, `3 hulls`, `1,200 hulls`. */
export function countText(count: number, one: string, many = `${one}s`): string {
  return `${count.toLocaleString("en-GB")} ${count === 1 ? one : many}`;
}

/** `40 s`, `3 min`, `2 h`. */
export function durationText(seconds: number): string {
  if (seconds < 90) return `${Math.round(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${Math.round(seconds / 3600)} h`;
}

/** A text as a sentence: with a capital, and a full stop. */
export function toSentence(text: string): string {
  return `${capitalize(text)}${text.endsWith(".") ? "" : "."}`;
}

/** A text that begins with a capital. */
export const capitalize = (text: string): string => `${text.charAt(0).toUpperCase()}${text.slice(1)}`;

/** `a`, `a and b`, `a, b and c`; of more than `most` only the first ones and how many there are besides. */
export function listText(words: readonly string[], most = 4): string {
  const rest = words.length - most;
  const all = rest > 1 ? [...words.slice(0, most), `${rest} more`] : words;
  return all.length < 2 ? all.join("") : `${all.slice(0, -1).join(", ")} and ${all.at(-1)}`;
}

/** How many assets a count is of, where that is not all of them: ` of the 400 looked at`. */
export function sampleText(lookedAt: number, assets: number): string {
  return lookedAt < assets ? ` of the ${lookedAt.toLocaleString("en-GB")} looked at` : "";
}

/** Who gave a label: `by you`, `propagated`. */
export function sourceText(source: string): string {
  return SOURCES[source] ?? "by machine";
}

const SOURCES: Readonly<Record<string, string>> = {
  file: "from a file",
  name: "from its name",
  user: "by you",
  repair: "by you",
  propagated: "propagated",
  like: "like another family",
  step: "by the steps shown",
  class: "like the steps shown",
  rebuild: "from a rebuilt body",
  vlm: "by a model",
  edit: "by an edit",
  plugin: "by a plug-in",
};

/** The name of an asset without the folders it lies in. */
export function shortName(asset: string): string {
  return asset.slice(asset.lastIndexOf("/") + 1);
}

/** The change from one number to another as `+12 %` or `−3 %`; null where there was nothing. */
export function changeText(before: number, after: number): string | null {
  if (before <= 0) return null;
  const percent = (100 * (after - before)) / before;
  const size = Math.abs(percent);
  const digits = size < 10 && size >= 0.05 ? 1 : 0;
  const sign = size < 0.05 ? "±" : percent < 0 ? "−" : "+";
  return `${sign}${size.toFixed(digits)} %`;
}

/** An error as the server writes it, in parts: what is wrong, without the path of the asset itself, and the remedy. */
export function errorParts(error: string, asset: string): { message: string; remedy: string | null } {
  const [first = "", ...rest] = error.split("\n");
  const at = first.indexOf(`${asset}: `);
  const message = at >= 0 && !first.slice(0, at).includes(" ") ? first.slice(at + asset.length + 2) : first;
  const remedy = rest.map((line) => line.trim()).filter(Boolean).join(" ");
  return { message, remedy: remedy || null };
}
