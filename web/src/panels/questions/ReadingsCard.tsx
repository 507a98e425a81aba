// The question which hulls a rule should take: pictures to choose from.
import { useMemo } from "react";
import { putOff, reply, showAsked } from "../../commands/question";
import { worthText } from "../../store/assessment";
import { sentenceName } from "../../store/commonParts";
import { useOwnNames } from "../../store/project";
import { choiceText, differing, selectOf } from "../../store/readings";
import { listText } from "../../store/words";
import type { ReviewQuestionView } from "../../wire";
import { HullsPicture, type RulePictureView, useRulePicture } from "../learn/RulePicture";
import { useExtractorHighlight } from "../learn/RuleText";
import { useCardKeys } from "./cardKeys";
import { whilePointed } from "../../ui/whilePointed";
import css from "./questions.module.css";
import { LaterReply, Reply, ShowReply } from "./Replies";

export function ReadingsCard({ question }: { question: ReviewQuestionView }) {
  const { asset, choices } = question;
  const rule = question.rule ?? 1;
  const worth = worthText(question);
  const telling = useMemo(() => differing(choices.map(selectOf)), [choices]);
  const picture = useRulePicture(asset, rule, telling);
  const [later, show, reject] = [() => void putOff(question), () => showAsked(question), () => void reply(question, {})];
  const picks = choices.map(({ id }) => () => void reply(question, { choice: id }));
  const [accept] = picks;
  const doing = useCardKeys({ choices: picks, reject, show, later, ...(accept && { accept }) });
  return (
    <section className={css.card} aria-labelledby={`question-${question.id}`}>
      <h3 id={`question-${question.id}`}>
        On <span title={asset}>{sentenceName(asset, useOwnNames())}</span>, which hulls should rule {rule} take?
      </h3>
      <div className={css.choices} data-many={choices.length > 2}>
        {choices.map((choice, k) => (
          <ChoiceButton key={choice.id} question={question} place={k} picture={picture} onClick={doing(picks[k])} />
        ))}
      </div>
      <div className={css.row}>
        <Reply keyName="N" tip="MeshForge looks for another reading" onClick={doing(reject)}>
          {choices.length > 2 ? "None of these" : "Neither"}
        </Reply>
        <ShowReply onClick={doing(show)} />
        <LaterReply onClick={doing(later)} />
      </div>
      {worth && <p className={css.dim}>{worth}</p>}
    </section>
  );
}

interface ChoiceButtonProps {
  question: ReviewQuestionView;
  place: number;
  picture: RulePictureView | "failed" | null;
  onClick: () => void;
}

/** One choice: a picture with its hulls, and what it is in words; pointing at it lights it up everywhere. */
function ChoiceButton({ question, place, picture, onClick }: ChoiceButtonProps) {
  const { choices } = question;
  const choice = choices[place];
  const point = useExtractorHighlight(choice?.text ?? "", question.rule ?? 1);
  if (!choice) return null;
  const hidden = outOfSight(question, place, picture);
  return (
    <button
      type="button"
      className={css.choice}
      aria-keyshortcuts={place ? String(place + 1) : "1 Y"}
      data-default={place === 0}
      onClick={onClick}
      {...whilePointed(point.on, point.off)}
    >
      <HullsPicture picture={picture} hulls={selectOf(choice)} label="" />
      <span className={css.choiceText}>
        <strong>
          <kbd>{place + 1}</kbd> {place === 0 && <kbd>Y</kbd>} {choiceText(choices, place)}
        </strong>
        <span className={css.dim}>{choice.sentence}</span>
        {hidden.length > 0 && <span className={css.facts}>{listText(hidden, 2)} not visible here</span>}
      </span>
    </button>
  );
}

/** Hulls by which a choice differs from others, where its picture does not show most of them. */
function outOfSight({ choices }: ReviewQuestionView, place: number, picture: RulePictureView | "failed" | null): string[] {
  if (!picture || picture === "failed") return [];
  const matters = new Set(differing(choices.map(selectOf)));
  const own = (choices[place]?.select ?? []).filter((name) => matters.has(name));
  const hidden = own.filter((name) => !picture.inSight.has(name));
  return 2 * hidden.length > own.length ? hidden : [];
}
