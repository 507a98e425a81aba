// The words of a rule and what each of them is, for colouring.
export interface Token {
  kind: "operator" | "action" | "label" | "direction" | "arrow" | "file" | "number" | "word" | "plain";
  text: string;
  /** The label that is meant, null for other words. */
  label: string | null;
}

const WORDS = /"(?:[^"\\\n]|\\.)*"|=>|->|[+-][XYZxyz]\b|[+-]?\d+(?:\.\d+)?|[^\W\d]\w*|\s+|./gu;
const OPERATORS = new Set(["All", "Is", "Attach", "Geo", "Union", "Intersect", "Diff"]);

/** The text of a rule or an extractor in pieces that, joined, are the text again. */
export function tokens(text: string): Token[] {
  const words = [...text.matchAll(WORDS)].map((found) => found[0]);
  let afterArrow = false;
  let before = "";
  let call = "";
  return words.map((word) => {
    const token = { text: word, ...meant(word, before, call, afterArrow) };
    if (word === "=>") afterArrow = true;
    if (word === "(") call = before;
    if (word.trim()) before = word;
    return token;
  });
}

function meant(word: string, before: string, call: string, afterArrow: boolean): Omit<Token, "text"> {
  const plain = (kind: Token["kind"]) => ({ kind, label: null });
  if (word === "=>" || word === "->") return plain("arrow");
  if (!afterArrow && before === "(" && call === "Is") return { kind: "label", label: unquoted(word) };
  if (afterArrow && before === "as" && word.trim()) return { kind: "label", label: unquoted(word) };
  if (!afterArrow && OPERATORS.has(word)) return plain("operator");
  if (/^[+-][XYZ]$/i.test(word)) return plain("direction");
  if (word.startsWith('"')) return plain("file");
  if (/^[+-]?\d/.test(word)) return plain("number");
  if (!/^[^\W\d]/u.test(word)) return plain("plain");
  const isAction = afterArrow && (before === "=>" || (before === "(" && call === "Each"));
  return plain(isAction ? "action" : "word");
}

function unquoted(word: string): string {
  if (!word.startsWith('"')) return word;
  try {
    return String(JSON.parse(word));
  } catch {
    return word;
  }
}
