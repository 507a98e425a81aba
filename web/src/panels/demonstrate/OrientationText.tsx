// The orientation as text.
import { type FormEvent, useState } from "react";
import { perform } from "../../store/edits";
import { Button } from "../../ui/Button";
import css from "./demonstrate.module.css";

export function OrientationText({ text, onDone }: { text: string; onDone: () => void }) {
  const [typed, setTyped] = useState(text);
  const save = async (event: FormEvent) => {
    event.preventDefault();
    if (typed.trim() === text || (await perform({ kind: "orient", text: typed.trim() }))) onDone();
  };
  return (
    <form className={css.form} onSubmit={(event) => void save(event)}>
      <input
        autoFocus
        className={[css.input, css.code].join(" ")}
        aria-label="Orientation as text"
        placeholder="+Z: Is(leg) -> Is(panel)"
        value={typed}
        onChange={(event) => setTyped(event.target.value)}
        onKeyDown={(event) => {
          if (event.key !== "Escape") return;
          event.preventDefault();
          onDone();
        }}
      />
      <p className={css.hint}>A direction, a colon, from where to where; a second pair after a comma. Empty: none.</p>
      <div className={css.buttons}>
        <Button look="primary" type="submit">
          Save
        </Button>
        <Button onClick={onDone}>Cancel</Button>
      </div>
    </form>
  );
}
