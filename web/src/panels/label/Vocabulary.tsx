// The labels that hulls can have: clicked to label or to paint, renamed, put in order, added and removed.
import { perform } from "../../store/edits";
import { useDesk } from "../../store/desk";
import { selectLabel } from "../../store/labelling";
import { useProject } from "../../store/project";
import { applyLabel } from "../../store/queue";
import { moved } from "../../store/vocabulary";
import { Note, Section } from "../../ui/Section";
import { useReorder } from "../../ui/useReorder";
import { AddLabels } from "./AddLabels";
import css from "./label.module.css";
import { LabelRow } from "./LabelRow";
import { Progress } from "./Progress";

export function Vocabulary() {
  const vocabulary = useProject((state) => state.project.vocabulary);
  const names = vocabulary.map((label) => label.name);
  const move = (from: number, to: number) => void perform({ kind: "vocabulary", labels: moved(names, from, to) });
  const reorder = useReorder("y", move);
  return (
    <Section title="Labels" aside={vocabulary.length > 0 && <Hint />}>
      {vocabulary.length === 0 && (
        <Note>What are the parts called? Type their names: the same ones on every asset.</Note>
      )}
      <ul className={css.labels}>
        {vocabulary.map((label, place) => (
          <LabelRow
            key={label.name}
            label={label}
            place={place}
            names={names}
            move={(to) => to >= 0 && to < names.length && move(place, to)}
            drag={reorder(place, place === names.length - 1)}
          />
        ))}
        {vocabulary.length > 0 && <NoLabel />}
      </ul>
      <AddLabels names={names} />
      {vocabulary.length > 0 && <Progress />}
    </Section>
  );
}

function Hint() {
  const some = useDesk((desk) => desk.selection.size > 0);
  return (
    <span className={css.hint}>{some ? "a click labels the selection" : "a click paints, Shift+click selects"}</span>
  );
}

function NoLabel() {
  const armed = useDesk((desk) => desk.brush === "");
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
