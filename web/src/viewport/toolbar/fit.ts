// Which parts of a row fit into its width.
interface Fitted {
  readonly id: string;
  readonly keep: number;
}

/** Between two parts, and of the button for the rest [px]. */
export const GAP = 8;
export const MORE = 28;

/** The ids of those that fit, by how long they are to be kept; parts of no width take no room. */
export function fittingParts(parts: readonly Fitted[], widths: ReadonlyMap<string, number>, room: number): ReadonlySet<string> {
  const need = (some: readonly Fitted[]) => some.reduce((sum, { id }) => sum + spaceOf(widths.get(id) ?? 0), -GAP);
  if (need(parts) <= room) return new Set(parts.map((part) => part.id));
  const kept: Fitted[] = [];
  for (const part of [...parts].sort((a, b) => b.keep - a.keep)) {
    // what is less wanted does not slip in where something more wanted did not fit
    if (need([...kept, part]) + GAP + MORE > room) break;
    kept.push(part);
  }
  return new Set(kept.map((part) => part.id));
}

const spaceOf = (width: number): number => (width > 0 ? width + GAP : 0);
