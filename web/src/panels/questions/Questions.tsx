// The one queue of questions: the card that makes most results right for a person's time; the view goes along with it.
import { CircleCheck, CircleQuestionMark, LoaderCircle } from "lucide-react";
import { type ReactNode, useCallback, useEffect, useMemo, useRef, useState } from "react";
import { showQuestion, showRepair } from "../../commands/learn";
import { lookAtHeld, showAsked, takeCall, useCardCalls } from "../../commands/question";
import { asReadings, isJudging, openQuestion } from "../../store/assessment";
import { useProject } from "../../store/project";
import { countText } from "../../store/words";
import { Button } from "../../ui/Button";
import type { AssessmentView, QuestionView, RepairView, ReviewQuestionView } from "../../wire";
import { CardFocusContext, type CardKeys, pressOnCard } from "./cardKeys";
import { PlainCard } from "./PlainCard";
import css from "./questions.module.css";
import { ReadingsCard } from "./ReadingsCard";
import { Repairs } from "./Repairs";
import { SpanCard } from "./SpanCard";

const NO_REPAIRS: readonly RepairView[] = [];

export function Questions() {
  const [skipped, skip] = useState<string | null>(null);
  const asked = useAsked(skipped);
  const box = useRef<HTMLDivElement>(null);
  const keys = useRef<CardKeys>({});
  const hold = useCallback(() => box.current?.focus({ preventScroll: true }), []);
  const focus = useMemo(() => ({ keys, hold }), [hold]);
  const calls = useCardCalls((state) => state.count);
  const repairs = useProject((state) => state.outcome?.repairs) ?? NO_REPAIRS;
  const [repair] = repairs;
  const id = asked ? (asked.own ?? asked.review)?.id : repair?.id;
  const last = useRef<string | null>(null);
  useEffect(() => {
    // only another question, or a call, moves the view
    const now = `${id} ${calls}`;
    if (now === last.current) return;
    last.current = now;
    if (takeCall()) hold();
    if (!id || !box.current?.contains(document.activeElement)) return;
    if (asked) showInView(asked);
    else if (repair) showRepair(repair);
  }, [id, calls, asked, repair, hold]);
  return (
    <CardFocusContext value={focus}>
      <div
        ref={box}
        tabIndex={-1}
        role="group"
        aria-label="What MeshForge asks"
        className={css.questions}
        onKeyDown={(event) => pressOnCard(event, keys.current, hold)}
      >
        {asked ? <Card key={id} asked={asked} onSkip={skip} /> : repairs.length === 0 && <NoQuestion />}
        {repairs.length > 0 && <Repairs repairs={repairs} withKeys={!asked} />}
      </div>
    </CardFocusContext>
  );
}

/** A question of learning itself, or one of the assessment. */
interface Asked {
  own: QuestionView | null;
  review: ReviewQuestionView | null;
}

/** What is asked now: what learning asks itself comes first, unless it was put off here. */
function useAsked(skipped: string | null): Asked | null {
  const assessment = useProject((state) => state.assessment);
  const outcome = useProject((state) => state.outcome);
  return useMemo(() => {
    const own = outcome?.question && outcome.question.id !== skipped ? outcome.question : null;
    const review = openQuestion({ assessment, outcome: outcome && { ...outcome, question: own } });
    return own ? { own, review: null } : review && { own: null, review };
  }, [assessment, outcome, skipped]);
}

function showInView({ own, review }: Asked): void {
  if (own) showQuestion(own);
  else if (review) showAsked(review);
}

function Card({ asked: { own, review }, onSkip }: { asked: Asked; onSkip: (id: string) => void }) {
  if (own) return <ReadingsCard question={own} onLater={() => onSkip(own.id)} />;
  if (!review) return null;
  if (review.kind === "span") return <SpanCard question={review} />;
  const readings = asReadings(review);
  return readings ? <ReadingsCard question={readings} review={review} /> : <PlainCard question={review} />;
}

/** What stands where the card would: it is being worked out, or nothing is left to ask. */
function NoQuestion() {
  const assessment = useProject((state) => state.assessment);
  const busy = useProject(isJudging);
  if (busy) return <Line icon={<LoaderCircle size={15} aria-hidden className={css.spinning} />} text="Working out what to ask…" />;
  return assessment?.assets.length ? <Over assessment={assessment} /> : null;
}

function Over({ assessment: { held, unseen } }: { assessment: AssessmentView }) {
  if (!held) return <Line icon={<CircleCheck size={15} aria-hidden />} text="Nothing is left to ask." mood={unseen ? "plain" : "good"} />;
  return (
    <Line icon={<CircleQuestionMark size={15} aria-hidden />} text={`Nothing more to ask, and ${countText(held, "result")} held.`}>
      <Button onClick={lookAtHeld}>Look at {held === 1 ? "it" : "them"}</Button>
    </Line>
  );
}

function Line({ icon, text, mood = "plain", children }: { icon: ReactNode; text: string; mood?: string; children?: ReactNode }) {
  return (
    <div className={css.wait} data-mood={mood} role="status">
      {icon}
      <span>{text}</span>
      {children}
    </div>
  );
}
