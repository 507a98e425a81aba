// A factor: a number to type and a slider for the usual range.
import { useState } from "react";
import { Slide } from "../../ui/Slide";
import css from "./demonstrate.module.css";

export function FactorField({
  value,
  onChange,
}: {
  value: string | number | boolean | undefined;
  onChange: (value: number) => void;
}) {
  const number = typeof value === "number" ? value : NaN;
  const [text, setText] = useState(String(value ?? ""));
  const shown = Number(text) === number ? text : String(number);
  const typed = (now: string) => {
    setText(now);
    onChange(now.trim() === "" ? NaN : Number(now.replace(",", ".")));
  };
  return (
    <div className={css.factor}>
      <input
        className={css.input}
        inputMode="decimal"
        aria-label="Factor"
        aria-invalid={!(number > 0)}
        value={Number.isNaN(number) ? text : shown}
        onChange={(event) => typed(event.target.value)}
        onKeyDown={(event) => event.key === "Escape" && event.currentTarget.blur()}
      />
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
