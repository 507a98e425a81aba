// The orientation directive as pairs of landmarks, read from its text and written back.
import { labelText } from "./actions";

interface Pair {
  /** `+Z` and the like. */
  readonly direction: string;
  /** Base extractors: `Is(leg)`, `All`. */
  readonly from: string;
  readonly to: string;
}

export interface Directive {
  readonly snap: boolean;
  readonly pairs: readonly Pair[];
}

const BASE = '(All|Is\\(\\s*(?:"(?:[^"\\\\]|\\\\.)*"|[^\\s")]+)\\s*\\))';
const PAIR = `([+-]\\w+)\\s*:\\s*${BASE}\\s*->\\s*${BASE}`;

/** What a directive's text says; null for one that is not understood. */
export function parseDirective(text: string): Directive | null {
  const whole = /^\s*(?:orient\s+)?(snap\s+)?(.*?)\s*$/s.exec(text);
  const rest = whole?.[2] ?? "";
  if (!rest) return { snap: false, pairs: [] };
  if (!new RegExp(`^${PAIR}(?:\\s*,\\s*${PAIR})*$`, "u").test(rest)) return null;
  const pairs = [...rest.matchAll(new RegExp(PAIR, "gu"))].map(([, direction = "", from = "", to = ""]) => ({
    direction,
    from,
    to,
  }));
  return { snap: whole?.[1] !== undefined, pairs };
}

export function directiveText({ snap, pairs }: Directive): string {
  const written = pairs.map(({ direction, from, to }) => `${direction}: ${from} -> ${to}`);
  return written.length ? `${snap ? "snap " : ""}${written.join(", ")}` : "";
}

/** The directive with a pair for a direction; it takes the place of one along the same axis, or else of the last of two. */
export function withPair(directive: Directive, pair: Pair): Directive {
  const same = directive.pairs.findIndex(({ direction }) => direction.slice(1) === pair.direction.slice(1));
  const at = same >= 0 ? same : Math.min(directive.pairs.length, 1);
  return { ...directive, pairs: [...directive.pairs.slice(0, at), pair, ...directive.pairs.slice(at + 1)] };
}

export function withoutPair(directive: Directive, at: number): Directive {
  return { ...directive, pairs: directive.pairs.filter((_, k) => k !== at) };
}

/** The landmarks that two clicked hulls stand for, or why they cannot be landmarks. */
export function pairFromClicks(direction: string, start: string | null, end: string | null): Pair | string {
  if (start === null || end === null) return "A hull without a label cannot be a landmark: label it first.";
  if (start === end) return `Both hulls are labelled ${start}: landmarks have two different labels.`;
  return { direction, from: `Is(${labelText(start)})`, to: `Is(${labelText(end)})` };
}
