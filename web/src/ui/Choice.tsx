// One of a few, side by side; arrow keys move between them.
import { ToggleGroup } from "radix-ui";
import type { ReactNode } from "react";
import css from "./ui.module.css";

interface Option<T extends string> {
  value: T;
  label: ReactNode;
  /** For screen readers and as a hint, where the label is a picture. */
  name?: string;
}

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
      value={props.value}
      onValueChange={(value) => value && props.onChange(value as T)}
    >
      {props.options.map(({ value, label, name }) => (
        <ToggleGroup.Item key={value} value={value} className={css.choiceItem} aria-label={name} title={name}>
          {label}
        </ToggleGroup.Item>
      ))}
    </ToggleGroup.Root>
  );
}
