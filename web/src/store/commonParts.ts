// Names that stand beside each other: what they have in common is left out, so that what tells them apart is read.
import { byAsset, placeOf } from "./hullPlaces";
import { groupBy, oncePer } from "./once";
import type { Scene } from "./scene";
import { shortName } from "./words";

const SIGN = /[/_.\-~: ]/;
const DIGIT = /\d/;

/**
 * What each name has alone: it is without what all have at their start and end, in whole words and numbers; where not all
 * begin alike, without what those have that begin with the word of most. Of every name something is left, and two stay two.
 */
export function findOwnParts(names: readonly string[]): (name: string) => string {
  const { head, tail } = commonTo(mostAlike(names));
  const own = (name: string) => {
    const rest = name.startsWith(head) ? name.slice(head.length) : name;
    return (rest.endsWith(tail) ? rest.slice(0, rest.length - tail.length) : rest) || name;
  };
  return new Set(names.map(own)).size === new Set(names).size ? own : (name) => name;
}

/** The same for a list that many ask about, worked out once. */
export const ownPartsOf = oncePer(findOwnParts);

/** What hulls of a scene are called in short; of several assets side by side the hull, then its asset. */
export const hullNamesOf = oncePer(({ parts, hulls }: Pick<Scene, "parts" | "hulls">): ((name: string) => string) => {
  if (!parts) return findOwnParts(hulls.map(({ name }) => name));
  const ofAssets = findOwnParts(parts.map(({ asset }) => asset));
  const rows = byAsset(hulls.flatMap(({ name }) => placeOf(name) ?? []));
  const ofHulls = new Map([...rows].map(([asset, names]) => [asset, findOwnParts(names)]));
  return (name) => {
    const place = placeOf(name);
    return place ? `${ofHulls.get(place.asset)?.(place.hull) ?? place.hull} · ${ofAssets(place.asset)}` : name;
  };
});

/** The names that begin with the word that more than half begin with; all where there is none. */
function mostAlike(names: readonly string[]): readonly string[] {
  const groups = groupBy(names, firstWord, (name) => name);
  return [...groups.values()].find((group) => 2 * group.length > names.length) ?? names;
}

const firstWord = (name: string): string => name.slice(0, Math.max(name.search(SIGN), 0)) || name.replace(/\d.*$/, "");

function commonTo(names: readonly string[]): { head: string; tail: string } {
  const [first = ""] = names;
  if (names.length < 2) return { head: "", tail: "" };
  const shortest = Math.min(...names.map((name) => name.length));
  let head = 0;
  while (head < shortest && names.every((name) => name[head] === first[head])) head++;
  while (head > 0 && !names.every((name) => isStart(name, head))) head--;
  let tail = 0;
  while (tail < shortest - head - 1 && names.every((name) => name.at(-1 - tail) === first.at(-1 - tail))) tail++;
  while (tail > 0 && !SIGN.test(first.at(-tail) ?? "")) tail--;
  return { head: first.slice(0, head), tail: first.slice(first.length - tail) };
}

/** Whether a word or a number begins at a place of a name; the number of `chair#2` begins with its sign. */
function isStart(name: string, at: number): boolean {
  const [before, here] = [name[at - 1] ?? "", name[at] ?? ""];
  if (here === "#") return true;
  return here !== "" && (SIGN.test(before) || (DIGIT.test(here) && !DIGIT.test(before) && before !== "#"));
}

/** A name that has at most so many letters, cut in its middle; its end, by which many differ, is the shorter part. */
export function cutMiddle(name: string, most: number): string {
  const end = Math.floor((most - 1) / 2);
  return name.length > most ? `${name.slice(0, most - 1 - end)}…${name.slice(name.length - end)}` : name;
}

/** A name on two lines of so many letters: cut in its middle where it is longer, broken after a sign where both lines hold it,
 * else where the first line is full. */
export function wrapName(name: string, letters: number): string {
  const shown = cutMiddle(name, 2 * letters);
  const at = shown.slice(0, letters).search(/[^/_.\-~: ]*$/);
  const end = shown.length - at <= letters ? at : letters;
  return shown.length > letters ? `${shown.slice(0, end)}\u200b${shown.slice(end)}` : shown;
}

const LONG = 24; // letters

/** The name of an asset in a sentence: without folders, and a long one without what all share. */
export function sentenceName(asset: string, own: (asset: string) => string): string {
  const name = shortName(asset);
  return name.length > LONG ? own(asset) : name;
}

/** A sentence of the server about some assets, with their names as in other sentences. */
export const sentenceOf = (text: string, assets: readonly string[], own: (asset: string) => string): string =>
  [...new Set(assets)].sort((a, b) => b.length - a.length).reduce((said, asset) => said.replaceAll(asset, () => sentenceName(asset, own)), text);
