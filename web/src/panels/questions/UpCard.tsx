// The question which way is up, where neither files nor the project say: one asset either way. It is asked once.
import { Thumbnail } from "../../pictures/Thumbnail";
import { perform } from "../../store/edits";
import { useProject } from "../../store/project";
import { pressOnCard } from "./cardKeys";
import css from "./questions.module.css";

const WAYS = [
  { up: "Z", text: "Z up, as it is" },
  { up: "Y", text: "Y up" },
] as const;

export function UpCard() {
  const asset = useProject(({ project }) => project.ask_up);
  if (asset === null) return null;
  const choices = WAYS.map(({ up }) => () => void perform({ kind: "up", up }));
  return (
    <section className={css.card} aria-labelledby="ask-up" onKeyDown={(event) => pressOnCard(event, { choices }, () => undefined)}>
      <h3 id="ask-up">Which way is up?</h3>
      <div className={css.choices}>
        {WAYS.map(({ up, text }, k) => (
          <button key={up} type="button" className={css.choice} data-default={k === 0} aria-keyshortcuts={String(k + 1)} onClick={choices[k]}>
            <Thumbnail asset={asset} of="source" up={up === "Y" ? "y" : "z"} label="" />
            <strong>{text}</strong>
          </button>
        ))}
      </div>
      <p className={css.dim}>For this view and pictures only; rules and files stay as they are.</p>
    </section>
  );
}
