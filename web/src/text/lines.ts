// A line of a program in coloured pieces: headers and comments here, rules as they are coloured everywhere.
import { type Token, tokens } from "../store/tokens";

export interface Piece {
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
  for (const { kind, text, label } of tokens(line.slice(start, end))) {
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
