// One choice of a question: a picture with its hulls, and what it is in words; pointing at it lights it up everywhere.
import { answer } from "../../commands/learning";
import { choiceText, differing } from "../../store/lessons";
import { listed } from "../../store/words";
import type { QuestionView } from "../../wire";
import { HullsPicture } from "./HullsPicture";
import css from "./learn.module.css";
import { useGeneralised } from "./useGeneralised";
import type { Seen } from "./useRulePicture";

export function ChoiceButton({ question, place, picture }: { question: QuestionView; place: number; picture: Seen | "failed" | null }) {
  const { choices, rule } = question;
  const choice = choices[place];
  const point = useGeneralised(choice?.extractor ?? "", rule);
  if (!choice) return null;
  const hidden = outOfSight(question, place, picture);
  return (
    <button
      type="button"
      className={css.choice}
      aria-keyshortcuts={String(place + 1)}
      onClick={() => void answer(question, place)}
      onPointerEnter={point.on}
      onPointerLeave={point.off}
      onFocus={point.on}
      onBlur={point.off}
    >
      <HullsPicture picture={picture} hulls={choice.select} label="" />
      <span className={css.choiceText}>
        <strong>
          <kbd>{place + 1}</kbd> {choiceText(choices, place)}
        </strong>
        <span className={css.dim}>{choice.sentence}</span>
        {hidden.length > 0 && <span className={css.facts}>{listed(hidden, 2)} not in sight here</span>}
      </span>
    </button>
  );
}

/** Hulls by which a choice differs from others, where its picture does not show most of them. */
function outOfSight({ choices }: QuestionView, place: number, picture: Seen | "failed" | null): string[] {
  if (!picture || picture === "failed") return [];
  const matters = new Set(differing(choices.map((choice) => choice.select)));
  const own = (choices[place]?.select ?? []).filter((name) => matters.has(name));
  const hidden = own.filter((name) => !picture.inSight.has(name));
  return 2 * hidden.length > own.length ? hidden : [];
}
