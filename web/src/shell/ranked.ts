// Finding lines by words.

/** Those with every word of the search; where it begins a title, or a word of it, they come first. */
export function ranked<T extends { title: string; aside: string }>(all: readonly T[], search: string): readonly T[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const [first] = words;
  if (first === undefined) return all;
  const place = ({ title }: T) => {
    const text = title.toLowerCase();
    if (text.startsWith(first)) return 0;
    return text.split(/[\s_/-]+/).some((word) => word.startsWith(first)) ? 1 : 2;
  };
  const fits = all.filter(({ title, aside }) => {
    const text = `${title} ${aside}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  return [...fits].sort((a, b) => place(a) - place(b));
}
