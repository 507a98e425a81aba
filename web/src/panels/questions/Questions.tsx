// The one queue of questions: the card that makes most results right for a person's time; the view goes along with it.
import { CircleCheck, CircleQuestionMark, LoaderCircle } from "lucide-react";
import { type ReactNode, useCallback, useEffect, useMemo, useRef } from "react";
import { lookAtHeld, showAsked } from "../../commands/question";
import { isJudging, openQuestion } from "../../store/assessment";
import { takeCall, useCalls } from "../../store/calls";
import { openText } from "../../store/goals";
import { useProject } from "../../store/project";
import { countText } from "../../store/words";
import { Button } from "../../ui/Button";
import type { AssessmentView, ReviewQuestionView } from "../../wire";
import { CardFocusContext, type CardKeys, pressOnCard } from "./cardKeys";
import { OrientationCard } from "./OrientationCard";
import { PlainCard } from "./PlainCard";
import css from "./questions.module.css";
import { ReadingsCard } from "./ReadingsCard";

export function Questions() {
  const asked = useProject(openQuestion);
  const box = useRef<HTMLDivElement>(null);
  const keys = useRef<CardKeys>({});
  const hold = useCallback(() => box.current?.focus({ preventScroll: true }), []);
  const focus = useMemo(() => ({ keys, hold }), [hold]);
  const calls = useCalls((state) => state.count);
  const last = useRef<string | null>(null);
  useEffect(() => {
    // only another question, or a call, moves the view
    const now = `${asked?.id} ${calls}`;
    if (now === last.current) return;
    last.current = now;
    if (takeCall("card")) hold();
    if (asked && box.current?.contains(document.activeElement)) showAsked(asked);
  }, [calls, asked, hold]);
  return (
    <CardFocusContext value={focus}>
      <div
        ref={box}
        tabIndex={-1}
        role="group"
        aria-label="What MeshForge asks"
        className={css.questions}
        data-asks
        onKeyDown={(event) => pressOnCard(event, keys.current, hold)}
      >
        {asked ? <Card key={asked.id} question={asked} /> : <NoQuestion />}
        {asked && (
          <p className={css.hint}>
            <kbd>U</kbd> to answer by keys
          </p>
        )}
      </div>
    </CardFocusContext>
  );
}

function Card({ question }: { question: ReviewQuestionView }) {
  switch (question.kind) {
    case "candidate":
    case "label":
      return <ReadingsCard question={question} />;
    case "orientation":
      return <OrientationCard question={question} />;
    default:
      return <PlainCard question={question} />;
  }
}

/** What stands where the card would: it is being worked out, or nothing is left to ask. */
function NoQuestion() {
  const assessment = useProject((state) => state.assessment);
  const busy = useProject(isJudging);
  if (busy) return <Line icon={<LoaderCircle size={15} aria-hidden className={css.spinning} />} text="Working out what to ask…" />;
  return assessment?.assets.length ? <Over assessment={assessment} /> : null;
}

function Over({ assessment: { need_review: open, unseen } }: { assessment: AssessmentView }) {
  const goals = useProject(openText);
  const text = goals ? `Nothing is left to ask; ${goals}.` : "Nothing is left to ask.";
  if (!open) return <Line icon={<CircleCheck size={15} aria-hidden />} text={text} mood={unseen || goals ? "plain" : "good"} />;
  return (
    <Line icon={<CircleQuestionMark size={15} aria-hidden />} text={`Nothing more to ask, and ${countText(open, "result")} ${open === 1 ? "needs" : "need"} review.`}>
      <Button onClick={lookAtHeld}>Look at {open === 1 ? "it" : "them"}</Button>
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
