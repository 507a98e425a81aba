// Which assets tell a reading from the others of its rule; knows neither DOM nor three.js.
import { api } from "../server/api";
import type { ReadingView } from "../wire";
import { useProject } from "./project";

export type Selection = Readonly<Record<string, readonly number[]>>;

export interface Rival {
  readonly belief: number;
  readonly assets: Selection;
}

/**
 * Assets on which it is enough to say what a reading selects so that no rival is left, as few as is easily found; the
 * first rules out the most belief. A rival that does the same everywhere needs no telling.
 */
export function telling(own: Selection, rivals: readonly Rival[], most = 3): string[] {
  const chosen: string[] = [];
  let left = rivals;
  while (left.length && chosen.length < most) {
    const [asset, gain] = best(own, left);
    if (asset === null || gain === 0) break;
    chosen.push(asset);
    left = left.filter((rival) => same(own[asset], rival.assets[asset]));
  }
  return chosen;
}

function best(own: Selection, rivals: readonly Rival[]): [string | null, number] {
  let found: [string | null, number] = [null, 0];
  for (const [asset, positions] of Object.entries(own)) {
    const out = rivals.filter((rival) => !same(positions, rival.assets[asset]));
    const gain = out.reduce((sum, rival) => sum + Math.max(rival.belief, 1e-6), 0);
    if (gain > found[1]) found = [asset, gain];
  }
  return found;
}

function same(a: readonly number[] | undefined, b: readonly number[] | undefined): boolean {
  return a === b || (a !== undefined && b !== undefined && a.length === b.length && a.every((k) => b.includes(k)));
}

/** So many of the most believable readings are told apart; the others hardly matter. */
const RIVALS = 8;

/** Assets on which an answer tells a reading from the others of its rule. */
export async function tellingAssets({ id, rule, extractor, differs_on }: ReadingView): Promise<string[]> {
  const readings = (useProject.getState().lesson?.readings ?? []).filter((other) => other.rule === rule && other.id !== id);
  const rivals = [...readings].sort((a, b) => b.belief - a.belief).slice(0, RIVALS);
  const own = await everywhere(extractor, rule);
  const known: Rival[] = [];
  for (const { belief, extractor: other } of rivals) known.push({ belief, assets: await everywhere(other, rule) });
  const found = telling(own, known);
  return found.length ? found : differs_on.slice(0, 1);
}

/** What an extractor selects on all assets; asked once more, as the server drops a request for a newer one. */
async function everywhere(extractor: string, rule: number): Promise<Selection> {
  const asked = await api.generalise(extractor, rule).catch(() => api.generalise(extractor, rule));
  return asked.assets;
}
