// Drafts of actions: read from a step's text, begun with sensible arguments, and the rule that each is for.
import type { ActionForm, Argument, AssetView, RuleLine } from "../wire";
import type { Draft } from "./desk";
import { PRIMITIVES } from "./steps";

type Value = string | number | boolean;
type Parts = Pick<Draft, "action" | "arguments" | "each" | "label">;

/** The draft that a step's text amounts to; null for a text that no form fits. */
export function parsedAction(text: string, forms: readonly ActionForm[]): Parts | null {
  const whole = /^(.*?)(?:\s+as\s+("(?:[^"\\]|\\.)*"|[\p{L}_][\p{L}\p{N}_]*))?$/u.exec(text.trim());
  const inner = /^Each\((.*)\)$/.exec(whole?.[1] ?? "");
  const call = /^(\w+)(?:\((.*)\))?$/.exec(inner?.[1] ?? whole?.[1] ?? "");
  const form = forms.find(({ name }) => name === call?.[1]);
  if (!call || !form) return null;
  const given = assigned(call[2]?.match(/"(?:[^"\\]|\\.)*"|[^\s,]+/g) ?? [], form.arguments);
  return given && { action: form.name, arguments: given, each: inner !== null, label: unquoted(whole?.[2] ?? "") };
}

/** Each written argument goes to the next of the form's that takes it. */
function assigned(words: readonly string[], wanted: readonly Argument[]): Record<string, Value> | null {
  const given: Record<string, Value> = {};
  let at = 0;
  for (const word of words) {
    while (at < wanted.length && !takes(wanted[at], word)) at += 1;
    const argument = wanted[at++];
    if (!argument) return null;
    given[argument.name] = argument.kind === "flag" ? true : argument.kind === "factor" ? Number(word) : unquoted(word);
  }
  return given;
}

function takes(argument: Argument | undefined, word: string): boolean {
  if (!argument) return false;
  if (argument.kind === "factor") return Number(word) > 0;
  if (argument.kind === "flag") return word === argument.name;
  const quoted = word.startsWith('"');
  if (argument.kind === "words" || !quoted) return argument.choices.includes(word);
  return true;
}

function unquoted(word: string): string {
  return word.startsWith('"') ? (JSON.parse(word) as string) : word;
}

/** The arguments that an action begins with. */
export function usualArguments(form: ActionForm, templates: readonly string[]): Record<string, Value> {
  const usual = ({ kind, choices }: Argument): Value =>
    kind === "factor" ? 0.9 : kind === "file" ? (templates[0] ?? "") : (choices[0] ?? "");
  const required = form.arguments.filter((argument) => argument.required);
  return Object.fromEntries(required.map((argument) => [argument.name, usual(argument)]));
}

/** Whether a word goes with the shape that is chosen: `tight` is for slanted primitives, `longest` for templates. */
export function goesWith(word: string, { geometry = "" }: Draft["arguments"]): boolean {
  const shape = String(geometry);
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

/** Places (from 0) of the family's rules that an asset says nothing about. */
export function openPlaces(rules: readonly RuleLine[], view: Pick<AssetView, "steps">): number[] {
  return rules.map((_, k) => k).filter((k) => view.steps[k]?.select == null);
}

/** The place of the first open rule that does such an action; null where there is none. */
export function placeFor(
  action: string,
  rules: readonly RuleLine[],
  view: Pick<AssetView, "steps">,
  forms: readonly ActionForm[],
): number | null {
  const does = (place: number) => parsedAction(rules[place]?.action ?? "", forms)?.action === action;
  return openPlaces(rules, view).find(does) ?? null;
}

/** The place (from 0) that accepting a draft writes: that of its rule, or a new one after all others. */
export function placeOf(draft: Pick<Draft, "editing">, rules: number, steps: number): number {
  return draft.editing ?? Math.max(rules, steps);
}
