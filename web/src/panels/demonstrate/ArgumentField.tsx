// One argument of an action, as the control that its kind asks for.
import type { Draft } from "../../store/desk";
import { goesWith } from "../../store/drafts";
import type { Argument } from "../../wire";
import { Check } from "../../ui/Check";
import { Choice } from "../../ui/Choice";
import { DirectionField } from "./DirectionField";
import { FactorField } from "./FactorField";
import { Labelled } from "./Labelled";
import { ShapeField } from "./ShapeField";
import { TemplateField } from "./TemplateField";

type Value = string | number | boolean;

interface ArgumentFieldProps {
  argument: Argument;
  value: Value | undefined;
  /** All arguments, since some go only with others. */
  given: Draft["arguments"];
  onChange: (value: Value) => void;
}

export function ArgumentField({ argument, value, given, onChange }: ArgumentFieldProps) {
  const { name, kind, wants } = argument;
  if (kind === "flag") {
    return (
      <Check checked={value === true} onChange={onChange}>
        {FLAGS[name] ?? name}
      </Check>
    );
  }
  const words = wordsOf(argument, given);
  if (kind === "words" && words.length < 2 && !argument.required) return null;
  return (
    <Labelled
      name={NAMES[name] ?? capital(name)}
      hint={wants}
      inline={kind === "words" && !isDirections(argument)}
      hidden={kind === "shape"}
    >
      {kind === "factor" && <FactorField value={value} onChange={onChange} />}
      {kind === "file" && <TemplateField value={String(value ?? "")} onChange={onChange} />}
      {kind === "shape" && <ShapeField primitives={argument.choices} value={String(value ?? "")} onChange={onChange} />}
      {kind === "words" && isDirections(argument) && <DirectionField value={String(value ?? "")} onChange={onChange} />}
      {kind === "words" && !isDirections(argument) && (
        <Choice
          name={NAMES[name] ?? name}
          value={String(value || USUAL)}
          options={words}
          onChange={(word) => onChange(word === USUAL ? "" : word)}
        />
      )}
    </Labelled>
  );
}

const FLAGS: Readonly<Record<string, string>> = { keep: "Keep the template's own size" };
const NAMES: Readonly<Record<string, string>> = {
  geometry: "By",
  fit: "Fit",
  axis: "Along",
  direction: "At the side",
  template: "Template",
};
const WORDS: Readonly<Record<string, string>> = {
  tight: "tight, in any direction",
  longest: "longest side matched",
  all: "all axes",
};

const isDirections = ({ choices }: Argument): boolean =>
  choices.every((word) => /^[+-]/.test(word)) && choices.length > 0;
const capital = (word: string): string => word.slice(0, 1).toUpperCase() + word.slice(1);

/** Stands for an optional word that is left out. */
const USUAL = "usual";

/** The words to choose from, as far as they go with the other arguments. */
function wordsOf({ choices, required }: Argument, given: Draft["arguments"]): { value: string; label: string }[] {
  const options = choices
    .filter((word) => goesWith(word, given))
    .map((value) => ({ value, label: WORDS[value] ?? value }));
  return required ? options : [{ value: USUAL, label: "bounding box" }, ...options];
}
