// Actions of the language: read from a step's text, written as text, and their arguments as a form has them.
import type { ActionForm, Argument } from "../wire";
import type { Draft } from "./workspace";

type Value = string | number | boolean;
type Parts = Pick<Draft, "action" | "arguments" | "each" | "label">;

/** The draft that a step's text amounts to; null for a text that no form fits. */
export function parseAction(text: string, forms: readonly ActionForm[]): Parts | null {
  const whole = /^(.*?)(?:\s+as\s+("(?:[^"\\]|\\.)*"|[\p{L}_][\p{L}\p{N}_]*))?$/u.exec(text.trim());
  const inner = /^Each\((.*)\)$/.exec(whole?.[1] ?? "");
  const call = /^(\w+)(?:\((.*)\))?$/.exec(inner?.[1] ?? whole?.[1] ?? "");
  const form = forms.find(({ name }) => name === call?.[1]);
  if (!call || !form) return null;
  const given = assignWords(call[2]?.match(/"(?:[^"\\]|\\.)*"|[^\s,]+/g) ?? [], form.arguments);
  return given && { action: form.name, arguments: given, each: inner !== null, label: unquote(whole?.[2] ?? "") };
}

/** Each written argument goes to the next of the form's that takes it. */
function assignWords(words: readonly string[], wanted: readonly Argument[]): Record<string, Value> | null {
  const given: Record<string, Value> = {};
  let at = 0;
  for (const word of words) {
    while (at < wanted.length && !accepts(wanted[at], word)) at += 1;
    const argument = wanted[at++];
    if (!argument) return null;
    given[argument.name] = argument.kind === "flag" ? true : argument.kind === "factor" ? Number(word) : unquote(word);
  }
  return given;
}

function accepts(argument: Argument | undefined, word: string): boolean {
  if (!argument) return false;
  if (argument.kind === "factor") return Number(word) > 0;
  if (argument.kind === "flag") return word === argument.name;
  const quoted = word.startsWith('"');
  if (argument.kind === "words" || !quoted) return argument.choices.includes(word);
  return true;
}

function unquote(word: string): string {
  return word.startsWith('"') ? (JSON.parse(word) as string) : word;
}

/** The arguments that an action begins with. */
export function defaultArguments(form: ActionForm, templates: readonly string[]): Record<string, Value> {
  const usual = ({ kind, choices }: Argument): Value =>
    kind === "factor" ? 0.9 : kind === "file" ? (templates[0] ?? "") : (choices[0] ?? "");
  const required = form.arguments.filter((argument) => argument.required);
  return Object.fromEntries(required.map((argument) => [argument.name, usual(argument)]));
}

/** Whether a word goes with the shape that is chosen: `native` is for round ones, `longest` for templates. */
export function goesWith(word: string, { geometry = "" }: Draft["arguments"]): boolean {
  const shape = String(geometry);
  if (word === "native") return ["cylinder", "capsule", "sphere"].includes(shape);
  if (word === "tight") return ["box", "cylinder", "capsule"].includes(shape);
  if (word === "longest") return shape !== "" && !PRIMITIVES.has(shape);
  return true;
}

/** The arguments with one of them changed, less those that no longer go with it. */
export function withArgument(given: Draft["arguments"], name: string, value: Value): Draft["arguments"] {
  const after = { ...given, [name]: value };
  return Object.fromEntries(Object.entries(after).filter(([, word]) => goesWith(String(word), after)));
}

/** The first argument that is still to be given. */
export function missingArgument(draft: Draft, form: ActionForm): Argument | undefined {
  return form.arguments.find(({ name, kind, required }) => {
    const value = draft.arguments[name];
    if (kind === "factor" && value !== undefined)
      return !(typeof value === "number" && value > 0 && Number.isFinite(value));
    return required && (value === undefined || value === "");
  });
}

/** The text of an action as the language has it. */
export function draftText(draft: Draft, order: readonly { name: string; kind: string }[]): string {
  const words = order.flatMap(({ name, kind }) => {
    const value = draft.arguments[name];
    if (value === undefined || value === "" || value === false) return [];
    if (kind === "flag") return [name];
    const isWord = kind !== "file" && (kind !== "shape" || PRIMITIVES.has(String(value)));
    return [isWord ? String(value) : JSON.stringify(value)];
  });
  const plain = words.length ? `${draft.action}(${words.join(", ")})` : draft.action;
  const whole = draft.each ? `Each(${plain})` : plain;
  return draft.label ? `${whole} as ${labelText(draft.label)}` : whole;
}

const PRIMITIVES: ReadonlySet<string> = new Set(["box", "cylinder", "capsule", "sphere"]);

const RESERVED = new Set("All Is Attach Geo Union Intersect Diff Delete Replace Add Merge Scale Each".split(" "));

/** A label as programs write it: quoted where it is no single word, or a word of the language. */
export function labelText(label: string): string {
  return /^[\p{L}_][\p{L}\p{N}_]*$/u.test(label) && !RESERVED.has(label) ? label : JSON.stringify(label);
}

/** The text of an action without the label that it gives, and that label. */
export function splitAction(text: string): { action: string; label: string | null } {
  const found = /^(.*?)\s+as\s+(?:"((?:[^"\\]|\\.)*)"|([\p{L}_][\p{L}\p{N}_]*))$/u.exec(text);
  return found ? { action: found[1] ?? text, label: found[2] ?? found[3] ?? null } : { action: text, label: null };
}
