// Every question but those of pictures: labels of look-alikes, slips, results, demonstrations.
import { TriangleAlert } from "lucide-react";
import { useMemo, useState } from "react";
import { demonstrate } from "../../commands/learn";
import { canBeRight, groupReply, labelByHand, putOff, reply, showAsked } from "../../commands/question";
import { Thumbnail } from "../../pictures/Thumbnail";
import { type Exceptions, placesOf, worthText } from "../../store/assessment";
import { failingGoals } from "../../store/goals";
import { isUpToDate } from "../../store/reviews";
import { sentenceOf } from "../../store/commonParts";
import { useOwnNames, useProject } from "../../store/project";
import { shortName, toSentence } from "../../store/words";
import { setHighlight } from "../../store/workspace";
import { Swatch } from "../../ui/Section";
import type { ReviewChoiceView, ReviewQuestionView } from "../../wire";
import { GoalPicture } from "../review/GoalFailures";
import { useCardKeys } from "./cardKeys";
import { GroupHulls, groupText } from "./GroupHulls";
import { whilePointed } from "../../ui/whilePointed";
import css from "./questions.module.css";
import { LaterReply, Reply, ShowReply } from "./Replies";
import { ResultReplies } from "./ResultReplies";

export function PlainCard({ question }: { question: ReviewQuestionView }) {
  const places = useMemo(() => placesOf(question), [question]);
  const point = () => question.hulls.length > 0 && setHighlight({ what: question.id, assets: places });
  const [exceptions, setExceptions] = useState<Exceptions>({});
  const worth = worthText(question);
  const text = sentenceOf(question.text, [question.asset, ...question.hulls.map(({ asset }) => asset)], useOwnNames());
  const [, asked = text, why] = /^(.*?\?) (.+)$/s.exec(text) ?? [];
  return (
    <section className={css.card} aria-labelledby={`question-${question.id}`} {...whilePointed(point, () => setHighlight(null))}>
      <GoalPictures question={question} />
      <h3 id={`question-${question.id}`} title={question.text}>{asked}</h3>
      {question.hulls.length > 0 && <GroupHulls question={question} exceptions={exceptions} onChange={setExceptions} />}
      {canBeRight(question) && <ResultPictures asset={question.asset} drawn={question.goals.length > 0} />}
      {question.kind === "result" ? <ResultReplies question={question} /> : <Replies question={question} exceptions={exceptions} />}
      {why && <p className={css.dim}>{why}</p>}
      {worth && <p className={css.dim}>{worth}</p>}
    </section>
  );
}

/** What fails on the result, where a goal does. */
function GoalPictures({ question: { asset, goals } }: { question: ReviewQuestionView }) {
  const card = useProject((state) => state.cards[asset]);
  return failingGoals(card, goals).map((goal) => <GoalPicture key={goal.name} asset={asset} goal={goal} />);
}

/** An asset before and after, where its result is written, and not `drawn` above; the view shows it at any rate. And
 * what stands out of it. */
function ResultPictures({ asset, drawn }: { asset: string; drawn: boolean }) {
  const made = useProject((state) => !drawn && isUpToDate(state.cards[asset]));
  const doubts = useProject((state) => state.confidence[asset]?.reasons);
  const alarms = (doubts ?? []).filter((doubt) => doubt.kind === "alarm");
  return (
    <>
      {made && (
        <div className={css.beforeAfter}>
          {(["before", "after"] as const).map((when) => (
            <figure key={when}>
              <Thumbnail asset={asset} of={when === "before" ? "source" : "output"} label={`${asset} ${when}`} />
              <figcaption>{when}</figcaption>
            </figure>
          ))}
        </div>
      )}
      {alarms.map(({ text }) => (
        <p key={text} className={css.alarm}>
          <TriangleAlert size={14} aria-label="Alarm" /> {toSentence(text)}
        </p>
      ))}
    </>
  );
}

interface Line {
  id: string;
  text: React.ReactNode;
  run: () => void;
}

/** The replies of a question, in the order of its choices, with their keys. */
function Replies({ question, exceptions }: { question: ReviewQuestionView; exceptions: Exceptions }) {
  const { kind, asset, hulls } = question;
  const isOfLabels = kind === "group" || kind === "repair";
  const lines = choicesOf(question, exceptions);
  const runOf = (id: string) => lines.find((line) => line.id === id)?.run;
  const accept = kind === "demonstrate" ? () => demonstrate(asset) : (runOf("yes") ?? (isOfLabels ? lines[0]?.run : undefined));
  const reject = isOfLabels ? () => labelByHand(question) : runOf("no");
  const [later, show] = [() => void putOff(question), () => showAsked(question)];
  const canShow = hulls.length > 0;
  const doing = useCardKeys({
    choices: lines.map(({ run }) => run),
    later,
    ...(accept && { accept }),
    ...(reject && { reject }),
    ...(canShow && { show }),
  });
  return (
    <div className={css.row}>
      {lines.map(({ id, text, run }, k) => (
        <Reply key={id} keyName={run === accept ? "Y" : run === reject ? "N" : String(k + 1)} look={k ? "plain" : "primary"} onClick={doing(run)}>
          {text}
        </Reply>
      ))}
      {kind === "demonstrate" && (
        <Reply keyName="Y" look="primary" onClick={() => demonstrate(asset)}>
          Demonstrate {shortName(asset)}
        </Reply>
      )}
      {isOfLabels && (
        <Reply keyName="N" look="quiet" tip="Selects the hulls in Label, to say it there; the question does not come back" onClick={doing(reject)}>
          None of these: label {hulls.length > 1 ? "them" : "it"}
        </Reply>
      )}
      {canShow && <ShowReply onClick={doing(show)} />}
      <LaterReply onClick={doing(later)} />
    </div>
  );
}

/** What a person may choose. */
function choicesOf(question: ReviewQuestionView, exceptions: Exceptions): readonly Line[] {
  const { kind, choices, hulls } = question;
  const [first] = choices;
  if (kind === "group" && first?.label && Object.keys(exceptions).length) {
    return [{ id: first.id, text: groupText(question, first.label, exceptions), run: () => void reply(question, groupReply(question, exceptions)) }];
  }
  return choices.map((choice) => ({
    id: choice.id,
    text: <ChoiceText choice={choice} many={kind === "group" && hulls.length > 1} />,
    run: () => void reply(question, { choice: choice.id }),
  }));
}

function ChoiceText({ choice: { label, text }, many }: { choice: ReviewChoiceView; many: boolean }) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === label)?.color);
  if (label === null) return toSentence(text).replace(/\.$/, "");
  return (
    <>
      <Swatch color={color ?? "var(--hull-unlabelled)"} />
      {many ? `All are ${label}` : `It is ${label}`}
    </>
  );
}
