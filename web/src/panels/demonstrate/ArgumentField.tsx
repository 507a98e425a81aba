// One argument of an action, as the control that its kind asks for.
import { Box, Circle, Cylinder, type LucideIcon, Pill } from "lucide-react";
import { type ReactNode, useId, useState } from "react";
import { goesWith } from "../../store/actions";
import type { Draft } from "../../store/workspace";
import { Check, Choice, Slide } from "../../ui/fields";
import type { ActionForm, Argument, AxisLandmarks } from "../../wire";
import css from "./demonstrate.module.css";
import { TemplateField } from "./TemplateField";

type Value = string | number | boolean;

interface ArgumentFieldProps {
  argument: Argument;
  value: Value | undefined;
  /** All arguments, since some go only with others. */
  given: Draft["arguments"];
  form: ActionForm;
  onChange: (value: Value) => void;
}

export function ArgumentField({ argument, value, given, form, onChange }: ArgumentFieldProps) {
  const { name, kind, title, wants } = argument;
  if (kind === "flag") {
    return (
      <Check checked={value === true} onChange={onChange}>
        {title}
      </Check>
    );
  }
  const words = wordsOf(argument, given, form);
  if (kind === "words" && words.length < 2 && !argument.required) return null;
  if (kind === "option" && !goesWith(name, 1, given, form)) return null;
  return (
    <Field name={title} hint={wants} inline={kind === "words" && !isDirections(argument)} hidden={kind === "shape"}>
      {kind === "factor" && <FactorField value={value} onChange={onChange} />}
      {(kind === "length" || kind === "option") && (
        <NumberField name={title} required={argument.required} value={value} onChange={onChange} />
      )}
      {kind === "file" && <TemplateField value={String(value ?? "")} onChange={onChange} />}
      {kind === "shape" && <ShapeField primitives={argument.choices} value={String(value ?? "")} onChange={onChange} />}
      {kind === "words" && isDirections(argument) && <DirectionField value={String(value ?? "")} onChange={onChange} />}
      {kind === "words" && !isDirections(argument) && words.length <= MOST_IN_A_ROW && (
        <Choice name={title} value={String(value ?? OMITTED)} options={words} onChange={onChange} />
      )}
      {kind === "words" && !isDirections(argument) && words.length > MOST_IN_A_ROW && (
        <select className={css.input} aria-label={title} value={String(value ?? OMITTED)} onChange={(event) => onChange(event.target.value)}>
          {words.map((word) => (
            <option key={word.value} value={word.value}>
              {word.label}
            </option>
          ))}
        </select>
      )}
    </Field>
  );
}

const isDirections = ({ choices }: Argument): boolean =>
  choices.every((word) => /^[+-]/.test(word)) && choices.length > 0;

/** More words than these do not fit side by side into the column. */
const MOST_IN_A_ROW = 4;

/** Stands for an optional word that is left out. */
const OMITTED = "";

/** The words to choose from, as far as they go with the other arguments. */
function wordsOf({ name, choices, required, words, omitted }: Argument, given: Draft["arguments"], form: ActionForm) {
  const options = choices
    .filter((word) => goesWith(name, word, given, form))
    .map((value) => ({ value, label: words[value] ?? value }));
  return required ? options : [{ value: OMITTED, label: omitted }, ...options];
}

interface NumberFieldProps {
  name: string;
  required: boolean;
  value: Value | undefined;
  onChange: (value: Value) => void;
}

/** A number above 0 to type; one that may be left out is left out where nothing is typed. */
function NumberField({ name, required, value, onChange }: NumberFieldProps) {
  const [text, setText] = useState(String(value ?? ""));
  const number = Number(text.replace(",", "."));
  return (
    <input
      className={css.input}
      inputMode="decimal"
      aria-label={name}
      aria-invalid={text.trim() === "" ? required : !(number > 0)}
      value={Number(value) === number || value === undefined || value === "" || !(Number(value) > 0) ? text : String(value)}
      onChange={(event) => {
        const now = event.target.value;
        setText(now);
        onChange(now.trim() === "" && !required ? "" : now.trim() === "" ? NaN : Number(now.replace(",", ".")));
      }}
      onKeyDown={(event) => event.key === "Escape" && event.currentTarget.blur()}
    />
  );
}

/** A factor: a number to type and a slider for the usual range. */
function FactorField({ value, onChange }: Pick<NumberFieldProps, "value" | "onChange">) {
  const number = typeof value === "number" ? value : NaN;
  return (
    <div className={css.factor}>
      <NumberField name="Factor" required value={value} onChange={onChange} />
      <Slide
        name="Factor"
        value={Number.isFinite(number) ? Math.min(Math.max(number, 0.1), 2) : 1}
        min={0.1}
        max={2}
        step={0.05}
        onChange={(now) => onChange(Number(now.toFixed(2)))}
      />
    </div>
  );
}

const ICONS: Readonly<Record<string, LucideIcon>> = { box: Box, cylinder: Cylinder, capsule: Pill, sphere: Circle };

interface ShapeFieldProps {
  primitives: readonly string[];
  value: string;
  onChange: (value: string) => void;
}

/** A primitive or a template. */
function ShapeField({ primitives, value, onChange }: ShapeFieldProps) {
  return (
    <>
      <div className={css.shapes}>
        {primitives.map((shape) => {
          const Icon = ICONS[shape] ?? Box;
          return (
            <button key={shape} type="button" className={css.shape} aria-pressed={value === shape} onClick={() => onChange(shape)}>
              <Icon size={18} aria-hidden />
              {shape}
            </button>
          );
        })}
      </div>
      <TemplateField value={primitives.includes(value) ? "" : value} onChange={onChange} />
    </>
  );
}

const AXES = [
  { axis: "X", words: ["+X", "-X"] },
  { axis: "Y", words: ["+Y", "-Y"] },
  { axis: "Z", words: ["+Z", "-Z"] },
] as const;
export type Direction = AxisLandmarks["axis"];
const MEANING: Readonly<Record<string, string>> = { "+Z": "top", "-Z": "bottom" };

/** One of the six directions of the upright asset, axis by axis. */
export function DirectionField({ value, onChange }: { value: string; onChange: (value: Direction) => void }) {
  return (
    <div className={css.directions} role="radiogroup" aria-label="Direction">
      {AXES.map(({ axis, words }) => (
        <div key={axis} data-axis={axis}>
          {words.map((word) => (
            <label key={word} data-on={word === value || undefined}>
              <input type="radio" className="visually-hidden" name="direction" checked={word === value} onChange={() => onChange(word)} />
              {word.replace("-", "−")}
              {MEANING[word] && <small>{MEANING[word]}</small>}
            </label>
          ))}
        </div>
      ))}
    </div>
  );
}

interface FieldProps {
  name: string;
  hint?: string;
  /** Whether the name stands beside the control. */
  inline?: boolean;
  /** Whether the name is for screen readers only. */
  hidden?: boolean;
  children: ReactNode;
}

/** A field of a form under its name; a group where it has several controls. */
export function Field({ name, hint, inline = false, hidden = false, children }: FieldProps) {
  const id = useId();
  return (
    <div className={css.labelled} data-inline={inline || undefined} role="group" aria-labelledby={id}>
      <span id={id} className={hidden ? "visually-hidden" : css.fieldName} title={hint}>
        {name}
      </span>
      {children}
    </div>
  );
}
