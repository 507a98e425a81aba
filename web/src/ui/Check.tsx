// A box to tick, with words.
import type { ReactNode } from "react";
import css from "./ui.module.css";

interface CheckProps {
  checked: boolean;
  disabled?: boolean;
  keys?: string;
  onChange: (checked: boolean) => void;
  children: ReactNode;
}

export function Check({ checked, disabled = false, keys, onChange, children }: CheckProps) {
  return (
    <label className={css.check}>
      <input
        type="checkbox"
        checked={checked}
        disabled={disabled}
        onChange={(event) => onChange(event.target.checked)}
      />
      <span>{children}</span>
      {keys && <kbd>{keys}</kbd>}
    </label>
  );
}
