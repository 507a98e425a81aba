// A label while its name is changed, in its place in the list.
import { useState } from "react";
import { perform } from "../../store/edits";
import { Swatch } from "../../ui/Section";
import type { VocabularyLabel } from "../../wire";
import css from "./label.module.css";

export function Rename({ label: { name, color }, onDone }: { label: VocabularyLabel; onDone: () => void }) {
  const [text, setText] = useState(name);
  const finish = () => {
    const now = text.trim();
    if (now && now !== name) void perform({ kind: "rename-label", old: name, new: now });
    onDone();
  };
  return (
    <li className={css.row}>
      <span className={css.label}>
        <kbd data-empty />
        <Swatch color={color} />
        <input
          autoFocus
          className={css.rename}
          aria-label={`New name of ${name}`}
          value={text}
          onFocus={(event) => event.target.select()}
          onChange={(event) => setText(event.target.value)}
          onBlur={finish}
          onKeyDown={(event) => {
            if (event.key === "Enter") finish();
            if (event.key === "Escape") onDone();
            if (event.key === "Enter" || event.key === "Escape") event.preventDefault();
          }}
        />
      </span>
    </li>
  );
}
