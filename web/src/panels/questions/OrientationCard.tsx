// The question whether assets are turned: one of them as it stands now, and turned.
import { putOff, reply, showAsked } from "../../commands/question";
import { Thumbnail } from "../../pictures/Thumbnail";
import { worthText } from "../../store/assessment";
import { sentenceOf } from "../../store/commonParts";
import { useOwnNames } from "../../store/project";
import { toSentence } from "../../store/words";
import type { ReviewQuestionView } from "../../wire";
import { useCardKeys } from "./cardKeys";
import css from "./questions.module.css";
import { LaterReply, ShowReply } from "./Replies";

export function OrientationCard({ question }: { question: ReviewQuestionView }) {
  const { asset, choices } = question;
  const worth = worthText(question);
  const picks = choices.map(({ id }) => () => void reply(question, { choice: id }));
  const [reject, accept] = picks;
  const [later, show] = [() => void putOff(question), () => showAsked(question)];
  const doing = useCardKeys({ choices: picks, later, show, ...(accept && { accept }), ...(reject && { reject }) });
  return (
    <section className={css.card} aria-labelledby={`question-${question.id}`}>
      <h3 id={`question-${question.id}`} title={question.text}>{sentenceOf(question.text, [asset], useOwnNames())}</h3>
      <div className={css.choices}>
        {choices.map(({ id, text, orient }, k) => (
          <button key={id} type="button" className={css.choice} data-default={!orient} aria-keyshortcuts={orient ? "Y" : "N"} onClick={doing(picks[k])}>
            <Thumbnail asset={asset} of="source" turned={orient} label="" />
            <strong>
              <kbd>{orient ? "Y" : "N"}</kbd> {toSentence(text).replace(/\.$/, "")}
            </strong>
          </button>
        ))}
      </div>
      <div className={css.row}>
        <ShowReply onClick={doing(show)} />
        <LaterReply onClick={doing(later)} />
      </div>
      {worth && <p className={css.dim}>{worth}</p>}
    </section>
  );
}
