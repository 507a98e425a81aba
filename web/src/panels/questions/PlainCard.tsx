// Every question but that for readings: labels of look-alikes, repairs, slips, orientations, results, demonstrations.
import { Check, Flag, TriangleAlert, X } from "lucide-react";
import { useMemo, useState } from "react";
import { demonstrate } from "../../commands/learn";
import { acceptResult, canBeRight, labelGroup, putOff, reply, setAside, showAsked } from "../../commands/question";
import { Thumbnail } from "../../pictures/Thumbnail";
import { type Exceptions, placesOf, worthText } from "../../store/assessment";
import { isUpToDate } from "../../store/reviews";
import { useProject } from "../../store/project";
import { shortName, toSentence } from "../../store/words";
import { setHighlight } from "../../store/workspace";
import { Swatch } from "../../ui/Section";
import type { ReviewQuestionView } from "../../wire";
import { type CardKeys, useCardKeys } from "./cardKeys";
import { GroupHulls, groupText } from "./GroupHulls";
import css from "./questions.module.css";
import { LaterReply, Reply, ShowReply } from "./Replies";

export function PlainCard({ question }: { question: ReviewQuestionView }) {
  const places = useMemo(() => placesOf(question), [question]);
  const point = () => question.hulls.length > 0 && setHighlight({ what: question.id, assets: places });
  const [exceptions, setExceptions] = useState<Exceptions>({});
  const worth = worthText(question);
  return (
    <section
      className={css.card}
      aria-labelledby="asked"
      onPointerEnter={point}
      onPointerLeave={() => setHighlight(null)}
      onFocus={point}
      onBlur={() => setHighlight(null)}
    >
      <h3 id="asked">{question.text}</h3>
      {question.hulls.length > 0 && <GroupHulls question={question} exceptions={exceptions} onChange={setExceptions} />}
      {canBeRight(question) && <ResultPictures asset={question.asset} />}
      <Replies question={question} exceptions={exceptions} />
      {worth && <p className={css.dim}>{worth}</p>}
    </section>
  );
}

/** An asset before and after, where its result is written; the view shows it at any rate. And what stands out of it. */
function ResultPictures({ asset }: { asset: string }) {
  const made = useProject((state) => isUpToDate(state.cards[asset]));
  const doubts = useProject((state) => state.confidence[asset]?.doubts);
  const alarms = (doubts ?? []).filter((doubt) => doubt.kind === "alarm");
  return (
    <>
      {made && (
        <div className={css.beforeAfter}>
          <figure>
            <Thumbnail asset={asset} of="source" label={`${asset} before`} />
            <figcaption>before</figcaption>
          </figure>
          <figure>
            <Thumbnail asset={asset} of="output" label={`${asset} after`} />
            <figcaption>after</figcaption>
          </figure>
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
  text: React.ReactNode;
  run: () => void;
}

/** The replies of a question by its kind, with their keys. */
function Replies({ question, exceptions }: { question: ReviewQuestionView; exceptions: Exceptions }) {
  const { kind, asset, hulls } = question;
  const later = () => void putOff(question);
  const show = () => showAsked(question);
  const mend = () => demonstrate(asset);
  const canShow = kind === "result" || hulls.length > 0;
  const [first, ...others] = choicesOf(question, exceptions);
  const reject = kind === "result" ? mend : kind === "group" || kind === "repair" ? later : undefined;
  const accept = kind === "demonstrate" ? mend : first?.run;
  const keys: CardKeys = {
    choices: [first, ...others].flatMap((line) => line?.run ?? []),
    later,
    ...(accept && { accept }),
    ...(reject && { reject }),
    ...(canShow && { show }),
  };
  const doing = useCardKeys(keys);
  return (
    <div className={css.row}>
      {first && (
        <Reply keyName="Y" look="primary" {...(kind === "result" && { icon: Check })} onClick={doing(first.run)}>
          {first.text}
        </Reply>
      )}
      {others.map(({ text, run }, k) => (
        <Reply key={k} keyName={String(k + 2)} onClick={doing(run)}>
          {text}
        </Reply>
      ))}
      {kind === "demonstrate" && (
        <Reply keyName="Y" look="primary" onClick={mend}>
          Demonstrate {shortName(asset)}
        </Reply>
      )}
      {kind === "result" && (
        <>
          <Reply keyName="N" icon={X} tip="Show on this asset what is right" onClick={mend}>
            {first ? "Wrong: correct it" : "Correct it"}
          </Reply>
          <Reply look="quiet" icon={Flag} tip="Flag it: it is no longer held, and not signed off" onClick={doing(() => void setAside(asset))}>
            Set aside
          </Reply>
        </>
      )}
      {(kind === "group" || kind === "repair") && (
        <Reply keyName="N" look="quiet" tip="Asks another question; label these hulls yourself where none fits" onClick={doing(later)}>
          None of these
        </Reply>
      )}
      {canShow && <ShowReply onClick={doing(show)} />}
      <LaterReply onClick={doing(later)} />
    </div>
  );
}

/** What a person may choose, the likeliest first. */
function choicesOf(question: ReviewQuestionView, exceptions: Exceptions): readonly Line[] {
  const { kind, asset, choices, hulls } = question;
  if (kind === "demonstrate") return [];
  if (kind === "result") return canBeRight(question) ? [{ text: "Right", run: () => void acceptResult(asset) }] : [];
  const lines = choices.map((choice, k) => ({
    text: <ChoiceText label={choice.label} text={choice.text} many={kind === "group" && hulls.length > 1} />,
    run: () => void reply(question, k),
  }));
  const [first] = choices;
  if (kind !== "group" || !first?.label || !Object.keys(exceptions).length) return lines;
  const { label } = first;
  return [{ text: groupText(question, label, exceptions), run: () => void labelGroup(question, label, exceptions) }];
}

function ChoiceText({ label, text, many }: { label: string | null; text: string; many: boolean }) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === label)?.color);
  if (label === null) return text.charAt(0).toUpperCase() + text.slice(1);
  return (
    <>
      <Swatch color={color ?? "var(--hull-unlabelled)"} />
      {many ? `All are ${label}` : `It is ${label}`}
    </>
  );
}
