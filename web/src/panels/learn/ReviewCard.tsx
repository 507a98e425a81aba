// The question that makes most results right for a person's time, as one card, whatever it is about.
import { Check, Clock, Crosshair, Flag, Play, X } from "lucide-react";
import { useMemo } from "react";
import { demonstrate } from "../../commands/learn";
import { putOff, reply, sayWrong, setAside, showAsked } from "../../commands/question";
import { Thumbnail } from "../../pictures/Thumbnail";
import { asReadings, placesOf, useOpenQuestion, worthText } from "../../store/assessment";
import { applyTo, whyNotApply } from "../../store/jobs";
import { useProject } from "../../store/project";
import { countText, shortName } from "../../store/words";
import { setHighlight, visit } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Swatch } from "../../ui/Section";
import type { ReviewQuestionView } from "../../wire";
import css from "./learn.module.css";
import { QuestionCard } from "./Question";
import { HullsPicture, useRulePicture } from "./RulePicture";

export function ReviewCard() {
  const question = useOpenQuestion();
  if (!question) return null;
  const readings = asReadings(question);
  if (readings) return <QuestionCard key={question.id} question={readings} worth={worthText(question)} later={<Later question={question} />} />;
  return <PlainCard key={question.id} question={question} />;
}

function PlainCard({ question }: { question: ReviewQuestionView }) {
  const places = useMemo(() => placesOf(question), [question]);
  const point = () => question.hulls.length > 0 && setHighlight({ what: question.id, assets: places });
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
      {question.hulls.length > 0 && <GroupPictures question={question} assets={Object.keys(places)} />}
      {question.kind === "result" && <ResultPictures asset={question.asset} />}
      <Replies question={question} />
      {worth && <p className={css.dim}>{worth}</p>}
    </section>
  );
}

const MOST = 6;

/** The assets of the hulls in question, with these highlighted. */
function GroupPictures({ question, assets }: { question: ReviewQuestionView; assets: readonly string[] }) {
  return (
    <ul className={css.group}>
      {assets.slice(0, MOST).map((asset) => {
        const names = question.hulls.filter((one) => one.asset === asset).map((one) => one.hull);
        return (
          <li key={asset}>
            <GroupAsset asset={asset} names={names} />
          </li>
        );
      })}
      {assets.length > MOST && <li className={css.dim}>and {countText(assets.length - MOST, "more asset")}</li>}
    </ul>
  );
}

/** An asset from a side where the hulls in question are seen, or through what hides them. */
function GroupAsset({ asset, names }: { asset: string; names: readonly string[] }) {
  const picture = useRulePicture(asset, 1, names);
  return (
    <button type="button" className={css.groupAsset} title={`${asset}: ${names.join(", ")}`} onClick={() => visit(asset, { kind: "source" }, names)}>
      <HullsPicture picture={picture} hulls={names} label="" />
      <span>
        {shortName(asset)} <b>{names.length}</b>
      </span>
    </button>
  );
}

/** An asset before and after, where its result is there as it would be now. */
function ResultPictures({ asset }: { asset: string }) {
  const made = useProject((state) => isMade(state.cards[asset]));
  return (
    <div className={css.beforeAfter}>
      <figure>
        <Thumbnail asset={asset} of="source" label={`${asset} before`} />
        <figcaption>before</figcaption>
      </figure>
      {made && (
        <figure>
          <Thumbnail asset={asset} of="output" label={`${asset} after`} />
          <figcaption>after</figcaption>
        </figure>
      )}
    </div>
  );
}

type State = ReturnType<typeof useProject.getState>;
const isMade = (card: State["cards"][string] | undefined): boolean =>
  card !== undefined && (card.output === "edited" || card.output === "unchanged") && card.stale.length === 0;

function Replies({ question }: { question: ReviewQuestionView }) {
  const { kind, asset, hulls } = question;
  return (
    <div className={css.row}>
      {kind === "result" && <ResultReplies question={question} />}
      {kind === "demonstrate" && (
        <Button look="primary" onClick={() => demonstrate(asset)}>
          Demonstrate {shortName(asset)}
        </Button>
      )}
      {kind !== "result" && kind !== "demonstrate" && <ChoiceReplies question={question} />}
      {(kind === "result" || hulls.length > 0) && (
        <Button look="quiet" icon={Crosshair} tip="Open the asset" onClick={() => showAsked(question)}>
          Show in the view
        </Button>
      )}
      <Later question={question} />
    </div>
  );
}

function ChoiceReplies({ question }: { question: ReviewQuestionView }) {
  const { kind, choices, hulls } = question;
  return choices.map((choice, k) => (
    <Button key={choice.text} look={k === 0 ? "primary" : "plain"} onClick={() => void reply(question, k)}>
      {choice.label === null ? (
        choice.text.charAt(0).toUpperCase() + choice.text.slice(1)
      ) : (
        <>
          <LabelSwatch name={choice.label} />
          {kind === "group" && hulls.length > 1 ? `All are ${choice.label}` : `It is ${choice.label}`}
        </>
      )}
    </Button>
  ));
}

function LabelSwatch({ name }: { name: string }) {
  const color = useProject((state) => state.project.vocabulary.find((label) => label.name === name)?.color);
  return <Swatch color={color ?? "var(--hull-unlabelled)"} />;
}

/** Right, wrong or set aside; a result that is not there as it would be now is made first. */
function ResultReplies({ question }: { question: ReviewQuestionView }) {
  const { asset } = question;
  const made = useProject((state) => isMade(state.cards[asset]));
  const blocked = useProject(whyNotApply);
  if (!made) {
    return (
      <Button look="primary" icon={Play} disabled={blocked !== null} tip={blocked ?? "Applies the program to this asset"} onClick={() => void applyTo([asset])}>
        Make this result
      </Button>
    );
  }
  return (
    <>
      <Button look="primary" icon={Check} onClick={() => void reply(question, 0)}>
        Right
      </Button>
      <Button icon={X} tip="Show on this asset what is right" onClick={() => sayWrong(asset)}>
        Wrong
      </Button>
      <Button icon={Flag} tip="Flag it: it is no longer held, and not signed off" onClick={() => void setAside(asset)}>
        Set aside
      </Button>
    </>
  );
}

function Later({ question }: { question: ReviewQuestionView }) {
  const last = question.kind === "group" || question.kind === "repair";
  return (
    <Button look="quiet" icon={Clock} tip="Asks another question; this one does not come back as long as nothing changes" onClick={() => void putOff(question)}>
      {last ? "None of these" : "Not now"}
    </Button>
  );
}
