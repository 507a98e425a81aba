// The question that is open: which hulls should a rule take? Pictures to choose from; 1, 2 and N are keys.
import { Crosshair } from "lucide-react";
import type { KeyboardEvent } from "react";
import { answer, showQuestion } from "../../commands/learning";
import { oneIn, shortName } from "../../store/words";
import type { QuestionView } from "../../wire";
import { Button } from "../../ui/Button";
import { ChoiceButton } from "./ChoiceButton";
import css from "./learn.module.css";
import { useRulePicture } from "./useRulePicture";

export function QuestionCard({ question }: { question: QuestionView }) {
  const { rule, asset, choices, harm } = question;
  const picture = useRulePicture(asset, rule);
  return (
    <section className={css.card} aria-labelledby="question" onKeyDown={(event) => byKey(event, question)}>
      <h3 id="question">
        On <span title={asset}>{shortName(asset)}</span>, which hulls should rule {rule} take?
      </h3>
      <div className={css.choices} data-many={choices.length > 2}>
        {choices.map((choice, k) => (
          <ChoiceButton key={choice.reading} question={question} place={k} picture={picture} />
        ))}
      </div>
      <div className={css.row}>
        <Button tip="Neither is right; the next lesson looks for another reading" keys="N" onClick={() => void answer(question, null)}>
          Neither
        </Button>
        <Button
          look="quiet"
          icon={Crosshair}
          tip="Open this asset with the hulls selected that it is about"
          onClick={() => showQuestion(question)}
        >
          Show me there
        </Button>
      </div>
      <p className={css.dim}>{worth(harm)}</p>
    </section>
  );
}

function worth(harm: number): string {
  return `Without an answer ${oneIn(harm)} would come out wrong.`;
}

function byKey(event: KeyboardEvent, question: QuestionView): void {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  const choice = Number(event.key) - 1;
  const isChoice = choice >= 0 && choice < question.choices.length;
  if (!isChoice && event.key.toUpperCase() !== "N") return;
  event.preventDefault();
  event.stopPropagation();
  void answer(question, isChoice ? choice : null);
}
