// The labels that hulls can have: clicked to label or to paint, renamed, put in order, added and removed.
import { Plus } from "lucide-react";
import { type FormEvent, useMemo, useRef, useState } from "react";
import { perform } from "../../store/edits";
import { addLabels, countLabels, moveItem, selectLabel } from "../../store/labels";
import { useProject } from "../../store/project";
import { applyLabel } from "../../store/labelWalk";
import { listText } from "../../store/words";
import { useWorkspace } from "../../store/workspace";
import { IconButton } from "../../ui/Button";
import { Note, Section } from "../../ui/Section";
import { useCalled } from "../../store/calls";
import { useReorder } from "../../ui/useReorder";
import css from "./label.module.css";
import { LabelRow } from "./LabelRow";

export function Vocabulary() {
  const vocabulary = useProject((state) => state.project.vocabulary);
  const cards = useProject((state) => state.cards);
  const counts = useMemo(() => countLabels(cards), [cards]);
  const some = useWorkspace((workspace) => workspace.selection.size > 0);
  const names = vocabulary.map((label) => label.name);
  const classes = vocabulary.filter((label) => label.is_class).map((label) => label.name);
  const move = (from: number, to: number) => void perform({ kind: "vocabulary", labels: moveItem(names, from, to) });
  const reorder = useReorder("y", move);
  const list = useRef<HTMLUListElement>(null);
  useCalled("vocabulary", () => (list.current?.querySelector("button") ?? list.current?.parentElement?.querySelector("input"))?.focus());
  return (
    <Section title="Labels" aside={vocabulary.length > 0 && <span className={css.hint}>{some ? "a click labels the selection" : "a click paints, Shift+click selects"}</span>}>
      {vocabulary.length === 0 && (
        <Note>No names are needed to begin: show the steps on one asset (2), and name its parts later, or now.</Note>
      )}
      {classes.length > 0 && (
        <Note>{listText(classes)} {classes.length === 1 ? "stands" : "stand"} for hulls that steps take. Rename them as you like.</Note>
      )}
      <ul className={css.labels} ref={list}>
        {vocabulary.map((label, place) => (
          <LabelRow
            key={label.name}
            label={label}
            used={counts && (counts.get(place) ?? 0)}
            place={place}
            names={names}
            move={(to) => to >= 0 && to < names.length && move(place, to)}
            drag={reorder(place, place === names.length - 1)}
          />
        ))}
        {vocabulary.length > 0 && <NoLabel />}
      </ul>
      <AddLabels names={names} />
    </Section>
  );
}

function NoLabel() {
  const armed = useWorkspace((workspace) => workspace.brush === "");
  return (
    <li className={css.row} data-armed={armed || undefined}>
      <button
        type="button"
        className={css.label}
        aria-pressed={armed}
        onClick={(event) => (event.shiftKey ? selectLabel(null) : void applyLabel(null))}
      >
        <kbd>0</kbd>
        <span className={css.none} aria-hidden />
        <em className={css.name}>No label</em>
      </button>
    </li>
  );
}

/** New labels, several at once between commas. */
function AddLabels({ names }: { names: readonly string[] }) {
  const [text, setText] = useState("");
  const labels = addLabels(names, text);
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
          This label is in the list already.
        </p>
      )}
    </form>
  );
}
