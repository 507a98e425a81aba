// Controls of a form: a box to tick, one choice of a few, a slider.
import { Slider, ToggleGroup } from "radix-ui";
import type { ReactNode } from "react";
import css from "./ui.module.css";

interface CheckProps {
  checked: boolean;
  keys?: string;
  onChange: (checked: boolean) => void;
  children: ReactNode;
}

export function Check({ checked, keys, onChange, children }: CheckProps) {
  return (
    <label className={css.check}>
      <input type="checkbox" checked={checked} onChange={(event) => onChange(event.target.checked)} />
      <span>{children}</span>
      {keys && <kbd>{keys}</kbd>}
    </label>
  );
}

interface Option<T extends string> {
  value: T;
  label: ReactNode;
  /** For screen readers and as a hint, where the label is a picture. */
  name?: string;
}

/** One of a few, side by side; arrow keys move between them. */
export function Choice<T extends string>(props: {
  name: string;
  value: T;
  options: readonly Option<T>[];
  onChange: (value: T) => void;
}) {
  return (
    <ToggleGroup.Root
      type="single"
      aria-label={props.name}
      className={css.choice}
      value={`=${props.value}`} // as an empty one, such as that of what is left out, would stand for none
      onValueChange={(value) => value && props.onChange(value.slice(1) as T)}
    >
      {props.options.map(({ value, label, name }) => (
        <ToggleGroup.Item key={value} value={`=${value}`} className={css.choiceItem} aria-label={name} title={name}>
          {label}
        </ToggleGroup.Item>
      ))}
    </ToggleGroup.Root>
  );
}

/** A slider with a name. */
export function Slide(props: {
  name: string;
  value: number;
  min?: number;
  max?: number;
  step?: number;
  onChange: (value: number) => void;
}) {
  return (
    <Slider.Root
      className={css.slide}
      value={[props.value]}
      min={props.min ?? 0}
      max={props.max ?? 1}
      step={props.step ?? 0.01}
      onValueChange={([value]) => value !== undefined && props.onChange(value)}
    >
      <Slider.Track className={css.slideTrack}>
        <Slider.Range className={css.slideRange} />
      </Slider.Track>
      <Slider.Thumb className={css.slideThumb} aria-label={props.name} />
    </Slider.Root>
  );
}
