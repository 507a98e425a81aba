// Arguments of actions as a form has them: what an action begins with, which values go together, what is missing.
import type { ActionCall, ActionForm, Argument, ArgumentValue } from "../wire";

type Call = Required<ActionCall>;
type Given = Call["arguments"];
type Value = Given[string];

/** The form of an action; none where the page has no fields for its arguments. */
export function formOf(name: string, forms: readonly ActionForm[]): ActionForm | undefined {
  return forms.find((form) => form.name === name);
}

/** What the page sends of an action that it has from the server. */
export function callOf({ name, arguments: given, each, label }: Call): Call {
  return { name, arguments: given, each, label };
}

/** Whether two actions do the same. */
export function isSameAction(one: Call, other: Call): boolean {
  const key = ({ name, arguments: given, each, label }: Call) =>
    JSON.stringify([name, Object.entries(given).sort(), each, label]);
  return key(one) === key(other);
}

/** The arguments that an action begins with. */
export function defaultArguments(form: ActionForm, templates: readonly string[]): Given {
  const required = form.arguments.filter((argument) => argument.required);
  return Object.fromEntries(required.map(({ name, kind, usual }) => [name, kind === "file" ? (templates[0] ?? "") : (usual ?? "")]));
}

/** Whether a value goes with those that are given for required arguments. */
export function goesWith(name: string, value: Value, given: Given, form: ActionForm): boolean {
  return form.arguments.every((other) => !other.required || !clash(name, value, other, given, form));
}

/** The arguments with one of them changed, less the options that no longer go with it, or say nothing. */
export function withArgument(given: Given, name: string, value: Value, form: ActionForm): Given {
  const after = { ...given, [name]: value };
  const stays = (other: Argument | undefined) => {
    if (!other || other.required) return true;
    const says = after[other.name] !== "" && after[other.name] !== false;
    return says && (other.name === name || !clash(name, value, other, after, form));
  };
  return Object.fromEntries(Object.entries(after).filter(([key]) => stays(form.arguments.find((one) => one.name === key))));
}

function clash(name: string, value: Value, other: Argument, given: Given, form: ActionForm): boolean {
  const beside = given[other.name];
  if (beside === undefined || other.name === name) return false;
  const fits = (one: ArgumentValue, key: string, now: Value) =>
    one.name === key && (one.value === null ? !choicesOf(key, form).includes(String(now)) : one.value === now);
  return form.clashes.some(
    ([one, two]) => (fits(one, name, value) && fits(two, other.name, beside)) || (fits(two, name, value) && fits(one, other.name, beside)),
  );
}

const choicesOf = (name: string, form: ActionForm): readonly string[] =>
  form.arguments.find((one) => one.name === name)?.choices ?? [];

/** The first argument that is still to be given. */
export function missingArgument({ arguments: given }: Call, form: ActionForm): Argument | undefined {
  return form.arguments.find((argument) => !isComplete(argument, given[argument.name]));
}

function isComplete({ kind, required }: Argument, value: Value | undefined): boolean {
  if (value === undefined || value === "") return !required;
  switch (kind) {
    case "factor":
    case "length":
    case "option":
    case "share":
      return typeof value === "number" && value > 0 && Number.isFinite(value);
    case "words":
    case "flag":
    case "file":
    case "shape":
    case "text":
    case "label":
    case "base":
    case "extractor":
      return true;
    default:
      return kind satisfies never;
  }
}
