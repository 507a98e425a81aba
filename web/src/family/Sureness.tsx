// How sure the edits of the family are, in one line; and of one asset, why its edit may be wrong.
import { CircleCheck, CircleQuestionMark, Crosshair, LoaderCircle } from "lucide-react";
import { useLayoutEffect, useMemo, useRef, useState } from "react";
import { lookAtHeld, showDoubt } from "../commands/question";
import { barText, countSigned, groupHeld, isJudging, lookText, moodOf, percentText, signedText, unseenText } from "../store/assessment";
import { openText } from "../store/goals";
import { useOwnNames, useProject } from "../store/project";
import { countText, listText, shortName } from "../store/words";
import { openAsset } from "../store/workspace";
import { Button } from "../ui/Button";
import { Section } from "../ui/Section";
import type { AssessmentView, Reason } from "../wire";
import css from "./sureness.module.css";

/** `Signed off 71 of 75`, as a bar and in words, with the way to those that are not. */
export function SignOff() {
  const assessment = useProject((state) => state.assessment);
  const judging = useProject(isJudging);
  const box = useRef<HTMLDivElement>(null);
  const [height, setHeight] = useState(0); // of what was there last, so that the cards below stay where they are meanwhile
  const isKnown = Boolean(assessment?.assets.length);
  useLayoutEffect(() => {
    if (isKnown) setHeight(box.current?.offsetHeight ?? 0);
  }, [isKnown, assessment]);
  if (!isKnown && !judging) return null;
  return (
    <div ref={box} style={{ minHeight: isKnown ? undefined : height }}>
      {isKnown && assessment ? (
        <Known assessment={assessment} />
      ) : (
        <p className={css.line} role="status">
          <LoaderCircle size={14} aria-hidden className={css.spinning} />
          <span>… sure: this is being worked out</span>
        </p>
      )}
    </div>
  );
}

function Known({ assessment }: { assessment: AssessmentView }) {
  const { threshold: bar, excluded } = assessment;
  const goals = useProject(openText);
  const signed = useProject(({ cards }) => countSigned(assessment, cards));
  const mood = moodOf(assessment, goals);
  const Icon = mood === "good" ? CircleCheck : CircleQuestionMark;
  const look = lookText(assessment);
  const more = [`at least ${barText(bar)} sure, or accepted by you`, excluded > 0 && `${excluded.toLocaleString("en-GB")} excluded`, unseenText(assessment), goals];
  return (
    <>
      <div className={css.line} data-mood={mood} role="status">
        <Icon size={14} aria-hidden />
        <div className={css.words}>
          <strong>{signedText(assessment, signed)}</strong>
          <Meter assessment={assessment} signed={signed} />
          <span>
            {more.filter(Boolean).join("; ")}
            {look && (
              <>
                {"; "}
                <button type="button" className={css.look} onClick={lookAtHeld}>
                  {look}
                </button>
              </>
            )}
          </span>
        </div>
      </div>
      <HeldReasons assessment={assessment} />
    </>
  );
}

/** The shares of the family that are signed off, excluded, to review, and not looked at or tried; the words beside it say the same. */
function Meter({ assessment: { signed_off, excluded, need_review, unseen }, signed }: { assessment: AssessmentView; signed: number }) {
  const shares = { signed, excluded, need_review, unseen: unseen + signed_off - signed };
  return (
    <span className={css.meter} aria-hidden>
      {Object.entries(shares).map(([what, count]) => count > 0 && <i key={what} data-what={what} style={{ flexGrow: count }} />)}
    </span>
  );
}

/** Why assets are held, reason by reason, each with a way to the first of its assets. */
function HeldReasons({ assessment }: { assessment: AssessmentView }) {
  const ownName = useOwnNames();
  const groups = useMemo(() => groupHeld(assessment), [assessment]);
  if (!groups.length) return null;
  return (
    <details className={css.reasons}>
      <summary>{countText(groups.length, "reason")} to look</summary>
      <ul>
        {groups.map(({ reason, assets, share }) => (
          <li key={reason}>
            <button type="button" className={css.look} title={assets.join("\n")} onClick={() => openAsset(assets[0] ?? null)}>
              {listText(assets.map(ownName), 3)}
            </button>{" "}
            ({share}){reason && `: ${reason}`}
          </li>
        ))}
      </ul>
    </details>
  );
}

/** How sure the edit of an asset is, and what makes it doubtful. */
export function Doubts({ asset }: { asset: string }) {
  const bar = useProject((state) => state.assessment?.threshold ?? null);
  const row = useProject((state) => state.confidence[asset]);
  const reasons = row?.reasons.filter(({ kind }) => kind !== "goal") ?? []; // which stand with their pictures
  if (!row || bar === null || (!reasons.length && row.state !== "needs review")) return null;
  return (
    <Section title={`Why ${shortName(asset)} may be wrong`} aside={<span data-state={row.state} className={css.sure}>{percentText(row.probability, bar)} sure</span>}>
      <ul className={css.doubts}>
        {reasons.map((doubt) => (
          <DoubtRow key={doubt.text} asset={asset} doubt={doubt} />
        ))}
      </ul>
    </Section>
  );
}

function DoubtRow({ asset, doubt }: { asset: string; doubt: Reason }) {
  const { text, hulls } = doubt;
  return (
    <li className={css.doubt}>
      <span>{text}</span>
      {hulls.length > 0 && (
        <Button look="quiet" icon={Crosshair} aria-label={`Show ${countText(hulls.length, "hull")}: ${text}`} onClick={() => showDoubt(asset, doubt)}>
          Show
        </Button>
      )}
    </li>
  );
}
