// The result of the open asset: verdict, numbers, findings, what each rule did, and edits by hand.
import { Check, RotateCw, SkipForward, Undo2, X } from "lucide-react";
import { useState } from "react";
import { accept, callWrong, exclude, nextToReview, noteWrong, withdrawReview } from "../../commands/review";
import { Doubts } from "../../family/Sureness";
import { ServerProblem } from "../../server/http";
import { failingGoals, isVoid } from "../../store/goals";
import { applyTo, whyNotApply } from "../../store/jobs";
import { leaveOut } from "../../store/members";
import { useProject } from "../../store/project";
import { isWritten, staleText } from "../../store/reviews";
import { errorParts, shortName } from "../../store/words";
import type { Scene } from "../../store/scene";
import { useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Note, ProblemNote, Section } from "../../ui/Section";
import type { Card } from "../../wire";
import { Checks } from "./Checks";
import { Corrections } from "./Corrections";
import { GoalsOfAsset } from "./GoalFailures";
import { ExcludeMenu } from "../questions/ExcludeMenu";
import { Findings, NumbersTable, Trace, useResult, useResultKind } from "./ResultDetails";
import css from "./review.module.css";

export function AssetReview() {
  const asset = useWorkspace((state) => state.asset);
  const there = useProject((state) => asset !== null && asset in state.cards);
  if (asset === null || !there) return <p className={css.empty}>Open an asset in the family on the left.</p>;
  return <OneAsset key={asset} asset={asset} />;
}

function OneAsset({ asset }: { asset: string }) {
  const result = useResult(asset, useResultKind(asset));
  const hasError = useProject((state) => state.cards[asset]?.error != null);
  const correcting = useWorkspace((state) => state.draft !== null);
  return (
    <>
      <VerdictSection asset={asset} />
      {correcting && <Corrections asset={asset} />}
      <Remarks asset={asset} />
      <GoalsOfAsset asset={asset} />
      <Doubts asset={asset} />
      {result instanceof ServerProblem && !hasError && (
        <Section title="Result">
          <ProblemNote {...result.problem} />
        </Section>
      )}
      {result && !(result instanceof ServerProblem) && <Details asset={asset} scene={result} />}
      {!correcting && <Corrections asset={asset} />}
    </>
  );
}

function Details({ asset, scene: { view, edit, showing } }: { asset: string; scene: Scene }) {
  if (!edit || showing.kind !== "result") return null;
  return (
    <>
      <NumbersTable asset={asset} before={view.hulls} edit={edit} />
      <Findings edit={edit} />
      <Checks asset={asset} />
      <Trace asset={asset} of={showing.of} edit={edit} />
    </>
  );
}

/** Accept the output of an asset, call it wrong, with a note, or exclude the asset. */
function VerdictSection({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  const some = useProject((state) => Object.values(state.cards).some(({ output }) => output !== "none"));
  if (!card) return null;
  const written = isWritten(card);
  const stale = card.stale.length > 0;
  const fails = failingGoals(card).length > 0;
  return (
    <Section title={shortName(asset)} aside={<ReviewState card={card} />}>
      <div className={css.row}>
        {written && card.review !== "accepted" && (
          <Button
            look={stale || fails ? "plain" : "primary"}
            icon={Check}
            disabled={stale}
            tip={stale ? "It is not up to date: apply first" : fails ? "Accept the result; the goal that fails stands beside it until you accept that, too" : "Accept and go to the next result to review"}
            keys="Y"
            onClick={() => void accept(asset)}
          >
            Accept
          </Button>
        )}
        {written && card.review !== "wrong" && (
          <Button icon={X} tip="It needs review until somebody says what is right" keys="F" onClick={() => void callWrong(asset, card.note)}>
            Wrong
          </Button>
        )}
        {card.review && (
          <Button icon={Undo2} onClick={() => void withdrawReview(asset)}>
            {card.review === "accepted" ? "Undo accept" : "Undo wrong"}
          </Button>
        )}
        {card.excluded ? (
          <Button icon={Undo2} tip={`It is excluded: ${card.excluded}`} onClick={() => void exclude(asset, null)}>
            Include again
          </Button>
        ) : (
          <ExcludeMenu onPick={(id) => void (id === "not-solved" ? exclude(asset, "not solved") : leaveOut([asset]))} />
        )}
        {some && (
          <Button look="quiet" icon={SkipForward} tip="Next failed, wrong or unreviewed result" keys="N" onClick={nextToReview}>
            Next
          </Button>
        )}
      </div>
      {card.review === "wrong" && <NoteField key={card.note ?? ""} card={card} />}
    </Section>
  );
}

function ReviewState({ card }: { card: Card }) {
  const sure = useProject((state) => state.confidence[card.asset]);
  if (card.excluded) return <span className={css.dim}>excluded: {card.excluded}</span>;
  if (isVoid(card, sure)) return <span className={css.warn}>changed since you accepted it</span>;
  if (card.review === "accepted") return <span className={css.good}>✓ accepted</span>;
  if (card.review === "wrong") return <span className={css.warn}>✗ wrong</span>;
  if (card.output === "failed") return <span className={css.bad}>✗ failed</span>;
  return <>{card.output === "none" ? "not applied yet" : "not reviewed"}</>;
}

function NoteField({ card }: { card: Card }) {
  const [note, setNote] = useState(card.note ?? "");
  const keep = () => {
    if (note.trim() !== (card.note ?? "")) void noteWrong(card.asset, note.trim() || null);
  };
  return (
    <input
      className={css.field}
      aria-label="Why it is wrong"
      placeholder="What is wrong with it? (Enter keeps the note)"
      value={note}
      onChange={(event) => setNote(event.target.value)}
      onBlur={keep}
      onKeyDown={(event) => event.key === "Enter" && event.currentTarget.blur()}
    />
  );
}

/** What must be known about an output: why it failed, that it is not up to date, what was left out. */
function Remarks({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  if (!card || (!card.error && !card.stale.length && !card.flags.length)) return null;
  return (
    <div className={css.remarks}>
      {card.error && <ProblemNote {...errorParts(card.error, asset)} />}
      {card.stale.length > 0 && <Stale asset={asset} reasons={card.stale} />}
      {card.flags.map((flag) => (
        <Note key={flag} mood="warn">
          ⚑ {flag}
        </Note>
      ))}
    </div>
  );
}

function Stale({ asset, reasons }: { asset: string; reasons: readonly string[] }) {
  const blocked = useProject(whyNotApply);
  return (
    <Note mood="warn">
      <div className={css.split}>
        <span>Not up to date: {staleText(reasons)}.</span>
        <Button icon={RotateCw} disabled={blocked !== null} onClick={() => void applyTo([asset])}>
          Apply here
        </Button>
      </div>
    </Note>
  );
}
