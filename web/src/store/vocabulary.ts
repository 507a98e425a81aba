// Changes to the list of labels; pure, each gives the whole list anew.

/** The labels with those of a typed list added, which stand between commas; ones already there are left out. */
export function withAdded(labels: readonly string[], typed: string): string[] {
  const words = typed.split(",").map((word) => word.trim().replaceAll(/\s+/g, " "));
  return [...new Set([...labels, ...words.filter(Boolean)])];
}

/** The list with one of its lines at another place. */
export function moved<T>(list: readonly T[], from: number, to: number): T[] {
  const rest = list.filter((_, k) => k !== from);
  const place = Math.min(Math.max(to, 0), rest.length);
  return [...rest.slice(0, place), ...list.slice(from, from + 1), ...rest.slice(place)];
}
