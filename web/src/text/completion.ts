// What may stand at a place of a program: operators, labels, directions, actions and their words.
import type { Argument, LanguageView } from "../wire";

export interface Suggestion {
  readonly label: string;
  /** Whether brackets follow. */
  readonly call?: boolean;
  readonly detail: string;
  readonly info?: string;
}

export interface Context {
  readonly language: LanguageView;
  /** As programs write them. */
  readonly labels: readonly string[];
  readonly templates: readonly string[];
}

/** The word before the end of a text, which a suggestion takes the place of. */
export function wordBefore(text: string): string {
  return /(?:"[^"]*|[+-]?[\p{L}\p{N}_]*)$/u.exec(text)?.[0] ?? "";
}

/** What may follow the text of a line; only an extractor where `bare`. */
export function suggestions(line: string, context: Context, bare: boolean): Suggestion[] {
  const before = line.slice(0, line.length - wordBefore(line).length);
  const action = bare ? -1 : before.lastIndexOf("=>");
  if (action >= 0) return forAction(before.slice(action + 2), context);
  if (/^\s*(?:labels|contact|extremity)\b/.test(before)) return [];
  const call = openCall(before);
  const operator = context.language.operators.find(({ name }) => name === call?.name);
  if (operator && call) return forOperand(operator.arguments[call.commas], context);
  if (/^\s*orient\b/.test(before)) return [...directions(context), ...operators(context, true)];
  return operators(context, false);
}

function forOperand(argument: Argument | undefined, context: Context): Suggestion[] {
  if (argument?.kind === "label") return labels(context);
  if (argument?.kind === "base" || argument?.kind === "extractor") return operators(context, argument.kind === "base");
  return (argument?.choices ?? []).map((label) => ({ label, detail: argument?.name ?? "" }));
}

/** The call that the end of a text stands in, and how many of its arguments are complete. */
export function openCall(text: string): { name: string; commas: number } | null {
  let depth = 0;
  let commas = 0;
  for (let k = text.length - 1; k >= 0; k -= 1) {
    const sign = text[k];
    if (sign === ")") depth += 1;
    else if (sign === "," && depth === 0) commas += 1;
    else if (sign === "(" && depth-- === 0) return { name: /\w*$/.exec(text.slice(0, k))?.[0] ?? "", commas };
  }
  return null;
}

function forAction(before: string, context: Context): Suggestion[] {
  if (/\bas\s*$/.test(before)) return labels(context);
  const call = openCall(before);
  if (!call || call.name === "Each") return [...actions(context), ...(call ? [] : each)];
  const form = context.language.actions.find(({ name }) => name === call.name);
  const all = form?.arguments ?? [];
  const next = all[call.commas];
  const argument = next?.required ? next : undefined;
  const takes = argument ? [argument] : all.filter(({ required }) => !required);
  const words = takes.flatMap(({ name, kind, choices }) =>
    choices.map((word) => ({ label: kind === "option" ? `${word} = ` : word, detail: name })),
  );
  const files = argument?.kind === "file" || argument?.kind === "shape" ? context.templates : [];
  return [...words, ...files.map((file) => ({ label: JSON.stringify(file), detail: "template" }))];
}

const each: readonly Suggestion[] = [
  { label: "Each", call: true, detail: "Each(action)", info: "Does the action to every connected part." },
];

function actions({ language }: Context): Suggestion[] {
  return language.actions.map((form) => ({
    label: form.name,
    call: form.arguments.some((argument) => argument.required),
    detail: form.usage,
    info: form.summary,
  }));
}

function operators({ language }: Context, onlyBases: boolean): Suggestion[] {
  return language.operators
    .filter(({ base }) => base || !onlyBases)
    .map(({ name, usage, summary }) => ({
      label: name,
      call: usage.includes("("),
      detail: usage,
      info: summary,
    }));
}

function labels({ labels: all }: Context): Suggestion[] {
  return all.map((label) => ({ label, detail: "label" }));
}

function directions({ language }: Context): Suggestion[] {
  return language.directions.map((label) => ({ label, detail: "direction" }));
}
