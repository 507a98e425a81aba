// The label of what an action makes: that of the hulls it is made of, or another one.
import { useProject } from "../../store/project";
import css from "./demonstrate.module.css";

export function MadeLabel({ value, onChange }: { value: string; onChange: (value: string) => void }) {
  const vocabulary = useProject((state) => state.project.vocabulary);
  return (
    <select
      className={css.input}
      aria-label="Label of what is made"
      value={value}
      onChange={(event) => onChange(event.target.value)}
    >
      <option value="">as what it is made of</option>
      {vocabulary.map(({ name }) => (
        <option key={name} value={name}>
          {name}
        </option>
      ))}
    </select>
  );
}
