// What was worked out or fetched before, and is kept; and groups of a list.

/** Works something out of an object once, however many ask, as long as it is the same object. */
export function oncePer<Key extends object, Result>(compute: (key: Key) => Result): (key: Key) => Result {
  const known = new WeakMap<Key, { result: Result }>();
  return (key) => {
    const found = known.get(key) ?? { result: compute(key) };
    known.set(key, found);
    return found.result;
  };
}

/** Keeps a value as the latest of a map, which holds so many at most. */
export function keepLatest<Value>(kept: Map<string, Value>, key: string, value: Value, most: number): void {
  kept.delete(key);
  kept.set(key, value);
  if (kept.size > most) kept.delete(kept.keys().next().value ?? "");
}

/** Values of rows by a key of theirs, in the order in which the keys come. */
export function groupBy<Row, Value>(rows: Iterable<Row>, key: (row: Row) => string, value: (row: Row) => Value): Map<string, Value[]> {
  const out = new Map<string, Value[]>();
  for (const row of rows) {
    const group = out.get(key(row));
    if (group) group.push(value(row));
    else out.set(key(row), [value(row)]);
  }
  return out;
}
