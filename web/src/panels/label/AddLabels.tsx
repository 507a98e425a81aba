// New labels, several at once between commas.
import { Plus } from "lucide-react";
import { type FormEvent, useState } from "react";
import { perform } from "../../store/edits";
import { withAdded } from "../../store/vocabulary";
import { IconButton } from "../../ui/Button";
import css from "./label.module.css";

export function AddLabels({ names }: { names: readonly string[] }) {
  const [text, setText] = useState("");
  const labels = withAdded(names, text);
  const known = text.trim() !== "" && labels.length === names.length;
  const add = async (event: FormEvent) => {
    event.preventDefault();
    if (labels.length > names.length && (await perform({ kind: "vocabulary", labels }))) setText("");
  };
  return (
    <form className={css.add} onSubmit={(event) => void add(event)}>
      <input
        className={css.field}
        aria-label="New labels, separated by commas"
        placeholder={names.length ? "Add labels…" : "door, drawer, handle, frame"}
        value={text}
        onChange={(event) => setText(event.target.value)}
        onKeyDown={(event) => event.key === "Escape" && event.currentTarget.blur()}
      />
      <IconButton icon={Plus} name="Add labels" type="submit" disabled={labels.length === names.length} />
      {known && (
        <p role="status" className={css.known}>
          It is in the list already.
        </p>
      )}
    </form>
  );
}
