// How much of the family is labelled.
import { useProject } from "../../store/project";
import { labelProgress } from "../../store/unsure";
import { counted } from "../../store/words";
import css from "./label.module.css";

export function Progress() {
  const cards = useProject((state) => state.cards);
  const { hulls, labelled } = labelProgress(cards);
  if (!hulls) return null;
  const text =
    labelled < hulls
      ? `${labelled.toLocaleString("en-GB")} of ${counted(hulls, "hull")} labelled`
      : "Every hull is labelled";
  return (
    <div className={css.progress}>
      <div
        className={css.bar}
        role="progressbar"
        aria-label="Labelled hulls"
        aria-valuemin={0}
        aria-valuemax={hulls}
        aria-valuenow={labelled}
        aria-valuetext={text}
      >
        <span style={{ width: `${(100 * labelled) / hulls}%` }} />
      </div>
      {text}
    </div>
  );
}
