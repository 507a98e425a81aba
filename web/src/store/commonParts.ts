// Names that stand beside each other: what they have in common, so that what tells them apart is what stays in sight.
import { oncePer } from "./once";

/** How many letters at the start and the end of a name its neighbours have, too. */
export interface CommonParts {
  readonly head: number;
  readonly tail: number;
}

export const NONE: CommonParts = { head: 0, tail: 0 };
const SIGN = /[/_.\-~: ]/;
const DIGIT = /\d/;

/**
 * What each name has in common with those that begin with the same word, in whole words and numbers; of every name
 * something is left.
 */
export function findCommonParts(names: readonly string[]): (name: string) => CommonParts {
  const groups = new Map<string, string[]>();
  for (const name of names) {
    const word = firstWord(name);
    const group = groups.get(word);
    if (group) group.push(name);
    else groups.set(word, [name]);
  }
  const parts = new Map([...groups].map(([word, group]) => [word, group.length < 2 ? NONE : commonTo(group)]));
  return (name) => parts.get(firstWord(name)) ?? NONE;
}

/** The same for a list that many ask about, worked out once. */
export const commonPartsOf = oncePer(findCommonParts);

const firstWord = (name: string): string => name.slice(0, Math.max(name.search(SIGN), 0)) || name.replace(/\d.*$/, "");

function commonTo(names: readonly string[]): CommonParts {
  const [first = ""] = names;
  const shortest = Math.min(...names.map((name) => name.length));
  let head = 0;
  while (head < shortest && names.every((name) => name[head] === first[head])) head++;
  while (head > 0 && !names.every((name) => isStart(name, head))) head--;
  let tail = 0;
  while (tail < shortest - head - 1 && names.every((name) => name.at(-1 - tail) === first.at(-1 - tail))) tail++;
  while (tail > 0 && !SIGN.test(first.at(-tail) ?? "")) tail--;
  return { head, tail };
}

/** Whether a word or a number begins at a place of a name. */
function isStart(name: string, at: number): boolean {
  const [before, here] = [name[at - 1] ?? "", name[at] ?? ""];
  return here !== "" && (SIGN.test(before) || (DIGIT.test(here) && !DIGIT.test(before)));
}

/** Letters at the end of what a name has alone that stay in sight where even that is too long. */
const END = 5;

/** A name in four parts: what is common, what is its own, the end of that, what is common again. */
export function splitName(name: string, { head, tail }: CommonParts): readonly [string, string, string, string] {
  const own = name.slice(head, name.length - tail);
  const cut = own.length > 2 * END ? own.length - END : own.length;
  return [name.slice(0, head), own.slice(0, cut), own.slice(cut), name.slice(name.length - tail)];
}
