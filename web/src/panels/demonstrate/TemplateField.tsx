// The project's templates, one of which is taken.
import { FileBox } from "lucide-react";
import { useProject } from "../../store/project";
import css from "./demonstrate.module.css";

export function TemplateField({ value, onChange }: { value: string; onChange: (value: string) => void }) {
  const { templates, folder } = useProject((state) => state.project);
  const all = value && !templates.includes(value) ? [...templates, value] : templates;
  return (
    <div className={css.templates}>
      {all.map((name) => (
        <button key={name} type="button" className={css.template} aria-pressed={value === name} onClick={() => onChange(name)} title={name}>
          <FileBox size={15} aria-hidden />
          <span>{name}</span>
        </button>
      ))}
      <p className={css.hint}>
        A shape of your own: copy its mesh file, of one or more convex hulls, into <code>{folder}/templates</code>.
      </p>
    </div>
  );
}
