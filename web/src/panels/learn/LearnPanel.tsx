// The learn stage: how learning stands, what is asked, and the program rule by rule.
import {
  Check,
  CircleAlert,
  CircleHelp,
  CornerUpLeft,
  Crosshair,
  GraduationCap,
  LoaderCircle,
  MessageCircleReply,
  Square,
  X,
} from "lucide-react";
import { learnNow, showNearest, stopLearning, withdraw } from "../../commands/learn";
import { summarizeOutcome, type Summary } from "../../store/outcome";
import { countSigned } from "../../store/assessment";
import { openText } from "../../store/goals";
import { countReadable, useProject } from "../../store/project";
import { useWorkspace } from "../../store/workspace";
import { Doubts } from "../../family/Sureness";
import { countText, listText, shortName } from "../../store/words";
import { Button, IconButton } from "../../ui/Button";
import { Section } from "../../ui/Section";
import type { OutcomeView, NearestView, AnswerView } from "../../wire";
import css from "./learn.module.css";
import { ProgramSection } from "./Program";
import { Questions } from "../questions/Questions";
import { RuleText } from "./RuleText";

export function LearnPanel() {
  const outcome = useProject((state) => state.outcome);
  const asset = useWorkspace((workspace) => workspace.asset);
  return (
    <>
      <LearnHead />
      <Questions />
      {outcome && <NoProgram outcome={outcome} />}
      {asset !== null && <Doubts asset={asset} />}
      <ProgramSection />
      <AnswerList />
    </>
  );
}

/** The button that learns, and how learning stands in words. */
function LearnHead() {
  const learning = useProject((state) => state.learning);
  const wanted = useProject(({ outcome }) => !outcome || outcome.status === "timeout" || outcome.status === "error");
  const taught = useProject((state) => state.project.rules.length > 0);
  return (
    <section className={css.head} aria-label="Learning">
      <LearnState />
      {learning ? (
        <Button icon={Square} onClick={() => void stopLearning()}>
          Stop
        </Button>
      ) : (
        <Button
          look={wanted ? "primary" : "plain"}
          icon={GraduationCap}
          disabled={!taught}
          tip={taught ? "Learn the program from your demonstrations and answers" : "Demonstrate the steps on an asset first"}
          keys="Ctrl+Enter"
          onClick={() => void learnNow()}
        >
          Learn
        </Button>
      )}
    </section>
  );
}

function LearnState() {
  const outcome = useProject((state) => state.outcome);
  const learning = useProject((state) => state.learning);
  const assets = useProject((state) => countReadable(state.cards));
  const assessment = useProject((state) => state.assessment);
  const assessing = useProject((state) => state.assessing);
  const goals = useProject(openText);
  const signed = useProject(({ cards }) => assessment && countSigned(assessment, cards)) ?? undefined;
  const summary = summarizeOutcome(outcome, assets, { assessment, assessing, goals, signed });
  const Icon = learning ? LoaderCircle : MOOD_ICONS[summary.mood];
  return (
    <div className={css.state} data-mood={learning ? "plain" : summary.mood} role="status">
      <Icon size={18} aria-hidden className={learning ? css.spinning : undefined} />
      <div>
        <strong>{learning ? "Learning…" : summary.title}</strong>
        {summary.more && <p>{learning ? "The program below is the previous one." : summary.more}</p>}
      </div>
    </div>
  );
}

const MOOD_ICONS: Record<Summary["mood"], typeof Check> = {
  plain: GraduationCap,
  good: Check,
  warn: CircleHelp,
  bad: CircleAlert,
};

const ANSWER_ICONS = { answer: MessageCircleReply, confirmed: Check, rejected: X } as const;
const KINDS = { answer: "Answer", confirmed: "Repair accepted", rejected: "Repair rejected" } as const;

/** What was said so far: answers and repairs, each of which can be taken back. */
function AnswerList() {
  const said = useProject((state) => state.project.answers);
  const stale = useProject((state) => state.outcome?.stale);
  if (!said.length) return null;
  return (
    <Section title="Your answers" aside={countText(said.length, "answer")}>
      <ul className={css.said}>
        {said.map((line) => (
          <AnswerRow key={`${line.kind} ${line.id}`} line={line} stale={stale?.includes(line.id) ?? false} />
        ))}
      </ul>
    </Section>
  );
}

function AnswerRow({ line, stale }: { line: AnswerView; stale: boolean }) {
  const Icon = ANSWER_ICONS[line.kind];
  return (
    <li className={css.saidRow}>
      <Icon size={14} aria-label={KINDS[line.kind]} />
      <span title={line.asset}>
        {line.text}
        {stale && <em className={css.stale}> no longer fits the demonstrations and is ignored</em>}
      </span>
      <IconButton icon={CornerUpLeft} name={`Withdraw: ${line.text}`} onClick={() => void withdraw(line.id)} />
    </li>
  );
}

/** Why there is no program, what came nearest, and what would help. */
function NoProgram({ outcome }: { outcome: OutcomeView }) {
  const { nearest, advice } = outcome;
  if (!nearest && !advice.length) return null;
  return (
    <Section title="What would help">
      {nearest && <Nearest nearest={nearest} />}
      {advice.length > 0 && (
        <ul className={css.advice}>
          {advice.map((line) => (
            <li key={line}>{line}</li>
          ))}
        </ul>
      )}
    </Section>
  );
}

function Nearest({ nearest }: { nearest: NearestView }) {
  const { rule, extractor, asset, extra, missing } = nearest;
  return (
    <div className={css.nearest}>
      <p>
        Nearest for rule {rule}: <RuleText text={extractor} />
      </p>
      <p>
        On <span title={asset}>{shortName(asset)}</span> it
      </p>
      <Difference nearest={nearest} names={extra} what="selects too much:" />
      <Difference nearest={nearest} names={missing} what="misses" />
    </div>
  );
}

function Difference({ nearest, names, what }: { nearest: NearestView; names: readonly string[]; what: string }) {
  if (!names.length) return null;
  return (
    <div className={css.split}>
      <p>
        {what} {countText(names.length, "hull")}: <span title={names.join(", ")}>{listText(names)}</span>
      </p>
      <Button
        look="quiet"
        icon={Crosshair}
        aria-label={`Show what it ${what} on ${nearest.asset}`}
        onClick={() => showNearest(nearest, names)}
      >
        Show
      </Button>
    </div>
  );
}
