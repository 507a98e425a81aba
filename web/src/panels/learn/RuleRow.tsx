// A rule in its own text with its sentence; what it selects lights up on all pictures while one points at it.
import { ChevronRight } from "lucide-react";
import { memo, useState } from "react";
import { setHighlight } from "../../store/desk";
import { extractorOf, highlightOfRule, reachOfRule, readingsOf, spreadText } from "../../store/lessons";
import { readable, useProject } from "../../store/project";
import { counted } from "../../store/words";
import type { RuleView } from "../../wire";
import css from "./learn.module.css";
import { Readings } from "./Readings";
import { RuleText } from "./RuleText";
import { useGeneralised } from "./useGeneralised";

interface RuleRowProps {
  rule: RuleView;
  /** Whether it is in the accepted program, of which is known what it reaches. */
  accepted: boolean;
  /** Whether it was learned, so that there are readings of it. */
  learned: boolean;
}

export const RuleRow = memo(function RuleRow({ rule, accepted, learned }: RuleRowProps) {
  const [open, setOpen] = useState(false);
  const point = usePointing(rule, accepted);
  return (
    <li className={css.rule}>
      <button
        type="button"
        className={css.ruleButton}
        aria-expanded={learned ? open : undefined}
        onClick={() => (learned ? setOpen(!open) : point.on())}
        onPointerEnter={point.on}
        onPointerLeave={point.off}
        onFocus={point.on}
        onBlur={point.off}
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
function usePointing({ rule, text }: RuleView, accepted: boolean): { on: () => void; off: () => void } {
  const asked = useGeneralised(extractorOf(text), rule);
  const on = () => {
    const { reach } = useProject.getState();
    if (accepted && reachOfRule(reach, rule)) setHighlight(highlightOfRule(reach, rule));
    else asked.on();
  };
  return { on, off: asked.off };
}

/** How much the rule selects in the family, and how many readings of it there are. */
function Facts({ rule, accepted, learned }: RuleRowProps) {
  const selects = useProject(({ reach, cards }) => {
    const found = accepted ? reachOfRule(reach, rule.rule) : null;
    return found && spreadText(found, readable(cards));
  });
  const readings = useProject((state) => (learned ? readingsOf(state.lesson, rule).length : 0));
  const fit = readings > 1 ? `${counted(readings, "reading")} fit` : readings === 1 ? "the only reading" : null;
  const facts = [selects, fit].filter((fact) => fact !== null).join(" · ");
  return facts ? <span className={css.facts}>{facts}</span> : null;
}
