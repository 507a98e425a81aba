// A field of a form under its name; a group where it has several controls.
import { type ReactNode, useId } from "react";
import css from "./demonstrate.module.css";

interface LabelledProps {
  name: string;
  hint?: string;
  /** Whether the name stands beside the control. */
  inline?: boolean;
  /** Whether only screen readers are told the name. */
  hidden?: boolean;
  children: ReactNode;
}

export function Labelled({ name, hint, inline = false, hidden = false, children }: LabelledProps) {
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
