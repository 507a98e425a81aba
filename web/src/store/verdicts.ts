// Whether written outputs are legal, asked for when one wants to know and kept as long as the output stays.
import { create } from "zustand";
import { api } from "../server/api";
import type { Card } from "../wire";
import { verdictOf } from "./reviews";

export type Verdict = ReturnType<typeof verdictOf>;

export const useVerdicts = create<{ verdicts: Readonly<Record<string, Verdict>> }>()(() => ({ verdicts: {} }));

/** So many are worked out at once; the others wait in one of these lines. */
const lines: Promise<unknown>[] = [Promise.resolve(), Promise.resolve(), Promise.resolve()];
const asked = new Map<string, Promise<Verdict>>();

/** What a verdict is kept by: another output of the asset is another key. */
export const verdictKey = (card: Card): string => `${card.asset}\n${card.edited_picture ?? ""}`;

/** The verdict on a card's output. */
export function verdict(card: Card): Promise<Verdict> {
  const key = verdictKey(card);
  const known = asked.get(key);
  if (known) return known;
  const line = asked.size % lines.length;
  const mine = (lines[line] ?? Promise.resolve()).then(() => checked(card.asset, key));
  lines[line] = mine.catch(() => asked.delete(key));
  asked.set(key, mine);
  return mine;
}

async function checked(asset: string, key: string): Promise<Verdict> {
  const { header } = await api.result(asset, "output");
  const found = verdictOf(header);
  useVerdicts.setState(({ verdicts }) => ({ verdicts: { ...verdicts, [key]: found } }));
  return found;
}
