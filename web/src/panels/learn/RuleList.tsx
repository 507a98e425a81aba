// The accepted program rule by rule; until there is one, the rules that the outcome has so far.
import { ChevronRight } from "lucide-react";
import { memo, useState } from "react";
import { chooseReading } from "../../commands/learn";
import { highlightOfRule } from "../../store/highlight";
import { coverageOfRule, coverageText } from "../../store/outcome";
import { countReadable, useOwnNames, useProject } from "../../store/project";
import { extractorOf, learnedDiffers, readingsOf } from "../../store/readings";
import { countText } from "../../store/words";
import { setHighlight, visit } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Name } from "../../ui/Name";
import type { CandidateView, RuleView } from "../../wire";
import { whilePointed } from "../../ui/whilePointed";
import css from "./learn.module.css";
import { RuleText, useExtractorHighlight } from "./RuleText";

const NONE: readonly RuleView[] = [];

export function RuleList() {
  const program = useProject((state) => state.program);
  const sofar = useProject((state) => state.outcome?.rules ?? NONE);
  if (program.rules.length) {
    return (
      <>
        {program.orient_sentence && <p className={css.orient}>{program.orient_sentence}</p>}
        <Rows rules={program.rules} accepted learned={!program.by_hand} />
        {program.by_hand && <Learned />}
      </>
    );
  }
  if (program.error) return null;
  if (!sofar.length) return <p className={css.dim}>The program appears here after the first demonstrated step.</p>;
  return (
    <>
      <p className={css.orient}>So far:</p>
      <Rows rules={sofar} accepted={false} learned />
    </>
  );
}

/** What was learned meanwhile, beside a program by hand. */
function Learned() {
  const rules = useProject((state) => (learnedDiffers(state.program, state.outcome) ? (state.outcome?.rules ?? NONE) : NONE));
  if (!rules.length) return null;
  return (
    <details className={css.learned}>
      <summary>The learned program</summary>
      <Rows rules={rules} accepted={false} learned />
    </details>
  );
}

function Rows({ rules, accepted, learned }: { rules: readonly RuleView[]; accepted: boolean; learned: boolean }) {
  return (
    <ol className={css.rules}>
      {rules.map((rule) => (
        <RuleRow key={rule.rule} rule={rule} accepted={accepted} learned={learned} />
      ))}
    </ol>
  );
}

interface RuleRowProps {
  rule: RuleView;
  /** Whether it is in the accepted program, of which is known what it reaches. */
  accepted: boolean;
  /** Whether it was learned, so that there are readings of it. */
  learned: boolean;
}

/** A rule in its own text with its sentence; what it selects is highlighted on all pictures while one points at it. */
const RuleRow = memo(function RuleRow({ rule, accepted, learned }: RuleRowProps) {
  const [open, setOpen] = useState(false);
  const point = useRuleHighlight(rule, accepted);
  return (
    <li className={css.rule}>
      <button
        type="button"
        className={css.ruleButton}
        aria-expanded={learned ? open : undefined}
        onClick={() => (learned ? setOpen(!open) : point.on())}
        {...whilePointed(point.on, point.off)}
      >
        <span className={css.number}>{rule.rule}</span>
        <span className={css.ruleBody}>
          <RuleText text={rule.text} />
          <span className={css.sentence}>{rule.sentence}</span>
          <Facts rule={rule} accepted={accepted} learned={learned} />
        </span>
        {learned && <ChevronRight size={14} aria-hidden className={css.chevron} />}
      </button>
      {open && learned && <Readings rule={rule} />}
    </li>
  );
});

/** Lights up what a rule selects: as the program reaches it, or, where that is not known, as the server works it out. */
function useRuleHighlight({ rule, text }: RuleView, accepted: boolean): { on: () => void; off: () => void } {
  const asked = useExtractorHighlight(extractorOf(text), rule);
  const on = () => {
    const { reach } = useProject.getState();
    if (accepted && coverageOfRule(reach, rule)) setHighlight(highlightOfRule(reach, rule));
    else asked.on();
  };
  return { on, off: asked.off };
}

/** How much the rule selects in the family, and how many readings of it there are. */
function Facts({ rule, accepted, learned }: RuleRowProps) {
  const selects = useProject(({ reach, cards }) => {
    const found = accepted ? coverageOfRule(reach, rule.rule) : null;
    return found && coverageText(found, countReadable(cards));
  });
  const readings = useProject((state) => (learned ? readingsOf(state.outcome, rule).length : 0));
  const fit = readings > 1 ? `${countText(readings, "reading")} fit` : readings === 1 ? "the only reading" : null;
  const facts = [selects, fit].filter((fact) => fact !== null).join(" · ");
  return facts ? <span className={css.facts}>{facts}</span> : null;
}

const MOST = 12;

/** The readings of a rule, side by side: all do what was shown, and differ elsewhere. */
function Readings({ rule }: { rule: RuleView }) {
  const outcome = useProject((state) => state.outcome);
  const readings = readingsOf(outcome, rule);
  const own = extractorOf(rule.text);
  if (!readings.length) return <p className={css.noReadings}>Learning found no other reading of this rule.</p>;
  return (
    <ul className={css.readings} aria-label={`Readings of rule ${rule.rule}`}>
      {readings.slice(0, MOST).map((reading) => (
        <ReadingRow key={reading.id} reading={reading} own={reading.extractor === own} />
      ))}
      {readings.length > MOST && <li className={css.dim}>and {readings.length - MOST} less probable readings</li>}
    </ul>
  );
}

/** One reading of a rule: what it says, how believable it is, and where it does something else. */
function ReadingRow({ reading, own }: { reading: CandidateView; own: boolean }) {
  const { rule, extractor, sentence, belief, size, differs_on: differs } = reading;
  const point = useExtractorHighlight(extractor, rule);
  const percent = Math.round(100 * belief);
  return (
    <li className={css.reading} data-own={own} {...whilePointed(point.on, point.off)}>
      <RuleText text={extractor} />
      <span className={css.sentence}>{sentence}</span>
      <span className={css.belief} title="Its probability and its number of parts: shorter readings are more probable">
        <span className={css.bar} aria-hidden>
          <span style={{ width: `${percent}%` }} />
        </span>
        {percent < 1 ? "< 1" : percent} % · {countText(size, "part")}
      </span>
      {own ? <span className={css.facts}>in the program</span> : <Elsewhere assets={differs} />}
      {!own && differs.length > 0 && (
        <Button tip="Answers the question on the assets where this reading differs from the others" onClick={() => void chooseReading(reading)}>
          Choose this reading
        </Button>
      )}
    </li>
  );
}

/** The assets on which a reading selects something else than the program's. */
function Elsewhere({ assets }: { assets: readonly string[] }) {
  const ownName = useOwnNames();
  if (!assets.length) return <span className={css.facts}>selects the same on all your assets</span>;
  return (
    <span className={css.facts}>
      differs on{" "}
      {assets.slice(0, 4).map((asset) => (
        <button key={asset} type="button" className={css.link} title={`Open ${asset}`} onClick={() => visit(asset, { kind: "source" })}>
          <Name text={asset} own={ownName(asset)} />
        </button>
      ))}
      {assets.length > 4 && <span>and {assets.length - 4} more</span>}
    </span>
  );
}
