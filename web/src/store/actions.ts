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
  const given = assignWords(call[2]?.match(/"(?:[^"\\]|\\.)*"|\w+\s*=\s*[^\s,]+|[^\s,]+/g) ?? [], form.arguments);
  return given && { action: form.name, arguments: given, each: inner !== null, label: unquote(whole?.[2] ?? "") };
}

/** Required arguments in their order, then options in any: each goes to the first of the form's that takes it. */
function assignWords(words: readonly string[], wanted: readonly Argument[]): Record<string, Value> | null {
  const given: Record<string, Value> = {};
  const left = [...wanted];
  for (const word of words) {
    const places = left[0]?.required ? left.slice(0, 1) : left;
    const argument = places.find((one) => accepts(one, word));
    if (!argument) return null;
    left.splice(left.indexOf(argument), 1);
    given[argument.name] = valueOf(argument, word);
  }
  return given;
}

function valueOf({ kind }: Argument, word: string): Value {
  if (kind === "flag") return true;
  return NUMBERS.has(kind) ? Number(word.slice(word.indexOf("=") + 1)) : unquote(word);
}

/** The kinds of arguments that are numbers above 0. */
export const NUMBERS: ReadonlySet<string> = new Set(["factor", "length", "option"]);

function accepts(argument: Argument | undefined, word: string): boolean {
  if (!argument) return false;
  if (argument.kind === "option")
    return word.includes("=") && word.split("=")[0]?.trim() === argument.name && Number(valueOf(argument, word)) > 0;
  if (NUMBERS.has(argument.kind)) return Number(word) > 0;
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
    kind === "factor" ? 0.9 : kind === "length" ? 0.002 : kind === "file" ? (templates[0] ?? "") : (choices[0] ?? "");
  const required = form.arguments.filter((argument) => argument.required);
  return Object.fromEntries(required.map((argument) => [argument.name, usual(argument)]));
}

const LONG = ["native", "tight", "inscribed", "volume", "X", "Y", "Z", "radius"];
const OPTIONS: Readonly<Record<string, readonly string[]>> = {
  box: ["tight", "inscribed", "volume"],
  cylinder: LONG,
  capsule: LONG,
  sphere: ["native", "inscribed", "volume", "longest", "radius"],
};
const ALL_OPTIONS: ReadonlySet<string> = new Set(Object.values(OPTIONS).flat());

/** Whether a word goes with the shape that is chosen, where it is an option of `Replace`. */
export function goesWith(word: string, { geometry = "" }: Draft["arguments"]): boolean {
  if (!ALL_OPTIONS.has(word)) return true;
  return geometry !== "" && (OPTIONS[String(geometry)] ?? ["longest"]).includes(word);
}

/** The options that another one takes the place of. */
const CLASHES: Readonly<Record<string, (given: Draft["arguments"]) => string[]>> = {
  fit: ({ fit }) => ["radius", ...(fit === "tight" ? ["axis"] : [])],
  radius: () => ["fit"],
  axis: ({ fit }) => (fit === "tight" ? ["fit"] : []),
};

/** The arguments with one of them changed, less those that no longer go with it. */
export function withArgument(given: Draft["arguments"], name: string, value: Value): Draft["arguments"] {
  const after = { ...given, [name]: value };
  const others = value ? (CLASHES[name]?.(after) ?? []) : [];
  const stays = ([key, word]: [string, unknown]) =>
    !others.includes(key) && goesWith(key === "radius" ? key : String(word), after);
  return Object.fromEntries(Object.entries(after).filter(stays));
}

/** The first argument that is still to be given. */
export function missingArgument(draft: Draft, form: ActionForm): Argument | undefined {
  return form.arguments.find(({ name, kind, required }) => {
    const value = draft.arguments[name];
    if (NUMBERS.has(kind) && value !== undefined && (required || value !== ""))
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
    if (kind === "option") return [`${name} = ${value}`];
    const isWord = kind !== "file" && (kind !== "shape" || PRIMITIVES.has(String(value)));
    return [isWord ? String(value) : JSON.stringify(value)];
  });
  const plain = words.length ? `${draft.action}(${words.join(", ")})` : draft.action;
  const whole = draft.each ? `Each(${plain})` : plain;
  return draft.label ? `${whole} as ${labelText(draft.label)}` : whole;
}

const PRIMITIVES: ReadonlySet<string> = new Set(["box", "cylinder", "capsule", "sphere"]);

const RESERVED = new Set("All Is Attach Geo Union Intersect Diff Delete Replace Add Merge Scale Shrink Each".split(" "));

/** A label as programs write it: quoted where it is no single word, or a word of the language. */
export function labelText(label: string): string {
  return /^[\p{L}_][\p{L}\p{N}_]*$/u.test(label) && !RESERVED.has(label) ? label : JSON.stringify(label);
}

/** The text of an action without the label that it gives, and that label. */
export function splitAction(text: string): { action: string; label: string | null } {
  const found = /^(.*?)\s+as\s+(?:"((?:[^"\\]|\\.)*)"|([\p{L}_][\p{L}\p{N}_]*))$/u.exec(text);
  return found ? { action: found[1] ?? text, label: found[2] ?? found[3] ?? null } : { action: text, label: null };
}
