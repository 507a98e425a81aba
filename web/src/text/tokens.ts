// Program text in coloured pieces: the words of a rule, and of a line with its header and comment.

interface Token {
  kind: "operator" | "action" | "label" | "direction" | "arrow" | "file" | "number" | "word" | "plain";
  text: string;
  /** The label that is meant, null for other words. */
  label: string | null;
}

const WORDS = /"(?:[^"\\\n]|\\.)*"|=>|->|[+-][XYZxyz]\b|[+-]?\d+(?:\.\d+)?|[^\W\d]\w*|\s+|./gu;

/** The text of a rule or an extractor in pieces that, joined, are the text again. */
export function tokenize(text: string): Token[] {
  const words = [...text.matchAll(WORDS)].map((found) => found[0]);
  let afterArrow = false;
  let before = "";
  let call = "";
  return words.map((word, k) => {
    const token = { text: word, ...classify(word, before, call, afterArrow, words[k + 1] === "(") };
    if (word === "=>") afterArrow = true;
    if (word === "(") call = before;
    if (word.trim()) before = word;
    return token;
  });
}

function classify(
  word: string,
  before: string,
  call: string,
  afterArrow: boolean,
  isCall: boolean,
): Omit<Token, "text"> {
  const plain = (kind: Token["kind"]) => ({ kind, label: null });
  if (word === "=>" || word === "->") return plain("arrow");
  if (!afterArrow && before === "(" && call === "Is") return { kind: "label", label: unquoted(word) };
  if (afterArrow && before === "as" && word.trim()) return { kind: "label", label: unquoted(word) };
  if (!afterArrow && (isCall || word === "All")) return plain("operator");
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

interface Piece {
  readonly from: number;
  readonly to: number;
  readonly kind: Token["kind"] | "keyword" | "comment";
  /** The label that is meant, null for other pieces. */
  readonly label: string | null;
}

const HEADER = /^(\s*)(labels|contact|extremity|orient)\b(\s+snap\b)?/;

/** The pieces of a line that have a look of their own, by where they are in it. */
export function piecesOf(line: string): Piece[] {
  const end = commentOf(line);
  const header = HEADER.exec(line.slice(0, end));
  const start = header?.[0].length ?? 0;
  const declares = header?.[2] === "labels";
  const out: Piece[] = header ? [{ from: header[1]?.length ?? 0, to: start, kind: "keyword", label: null }] : [];
  let at = start;
  for (const { kind, text, label } of tokenize(line.slice(start, end))) {
    const named = declares && (kind === "word" || kind === "operator" || kind === "file");
    if (named) out.push({ from: at, to: at + text.length, kind: "label", label: text.replaceAll('"', "") });
    else if (kind !== "plain") out.push({ from: at, to: at + text.length, kind, label });
    at += text.length;
  }
  return end < line.length ? [...out, { from: end, to: line.length, kind: "comment", label: null }] : out;
}

/** Where the comment of a line begins; its end where it has none. */
function commentOf(line: string): number {
  const code = /^(?:"(?:[^"\\]|\\.)*"|[^"#]|"(?![^"]*"))*/.exec(line)?.[0] ?? "";
  return code.length;
}
