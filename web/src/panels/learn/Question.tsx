// The question that is open: which hulls should a rule take? Pictures to choose from; 1, 2 and N are keys.
import { Crosshair } from "lucide-react";
import { type KeyboardEvent, type ReactNode, useMemo } from "react";
import { answer, showQuestion } from "../../commands/learn";
import { choiceText, differing } from "../../store/readings";
import { listText, shareText, shortName } from "../../store/words";
import { Button } from "../../ui/Button";
import type { QuestionView } from "../../wire";
import css from "./learn.module.css";
import { HullsPicture, type RulePictureView, useRulePicture } from "./RulePicture";
import { useExtractorHighlight } from "./RuleText";

interface QuestionCardProps {
  question: QuestionView;
  /** What an answer is worth, where that is not the harm of none. */
  worth?: string | null;
  /** What stands beside the buttons. */
  later?: ReactNode;
}

export function QuestionCard({ question, worth, later }: QuestionCardProps) {
  const { rule, asset, choices, harm } = question;
  const why = worth === undefined ? worthText(harm) : worth;
  const telling = useMemo(() => differing(choices.map((choice) => choice.select)), [choices]);
  const picture = useRulePicture(asset, rule, telling);
  return (
    <section className={css.card} aria-labelledby={`question-${question.id}`} onKeyDown={(event) => answerByKey(event, question)}>
      <h3 id={`question-${question.id}`}>
        On <span title={asset}>{shortName(asset)}</span>, which hulls should rule {rule} take?
      </h3>
      <div className={css.choices} data-many={choices.length > 2}>
        {choices.map((choice, k) => (
          <ChoiceButton key={choice.reading} question={question} place={k} picture={picture} />
        ))}
      </div>
      <div className={css.row}>
        <Button tip="Neither is right: MeshForge looks for another reading" keys="N" onClick={() => void answer(question, null)}>
          Neither
        </Button>
        <Button
          look="quiet"
          icon={Crosshair}
          tip="Open this asset and select the hulls in question"
          onClick={() => showQuestion(question)}
        >
          Show in the view
        </Button>
        {later}
      </div>
      {why && <p className={css.dim}>{why}</p>}
    </section>
  );
}

function worthText(harm: number): string {
  return `Without an answer ${shareText(harm)} would be edited wrongly.`;
}

function answerByKey(event: KeyboardEvent, question: QuestionView): void {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const choice = Number(event.key) - 1;
  const isChoice = choice >= 0 && choice < question.choices.length;
  if (!isChoice && event.key.toUpperCase() !== "N") return;
  event.preventDefault();
  event.stopPropagation();
  void answer(question, isChoice ? choice : null);
}

/**
 * One choice of a question: a picture with its hulls, and what it is in words; pointing at it lights it up
 * everywhere.
 */
function ChoiceButton({ question, place, picture }: { question: QuestionView; place: number; picture: RulePictureView | "failed" | null }) {
  const { choices, rule } = question;
  const choice = choices[place];
  const point = useExtractorHighlight(choice?.extractor ?? "", rule);
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
        {hidden.length > 0 && <span className={css.facts}>{listText(hidden, 2)} not visible here</span>}
      </span>
    </button>
  );
}

/** Hulls by which a choice differs from others, where its picture does not show most of them. */
function outOfSight({ choices }: QuestionView, place: number, picture: RulePictureView | "failed" | null): string[] {
  if (!picture || picture === "failed") return [];
  const matters = new Set(differing(choices.map((choice) => choice.select)));
  const own = (choices[place]?.select ?? []).filter((name) => matters.has(name));
  const hidden = own.filter((name) => !picture.inSight.has(name));
  return 2 * hidden.length > own.length ? hidden : [];
}
