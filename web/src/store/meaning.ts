// Which assets tell a reading from the others of its rule; knows neither DOM nor three.js.
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
