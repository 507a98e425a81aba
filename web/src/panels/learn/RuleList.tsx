// The accepted program rule by rule; until there is one, the rules that the lesson has so far.
import { learnedDiffers } from "../../store/lessons";
import { useProject } from "../../store/project";
import type { RuleView } from "../../wire";
import css from "./learn.module.css";
import { RuleRow } from "./RuleRow";

const NONE: readonly RuleView[] = [];

export function RuleList() {
  const program = useProject((state) => state.program);
  const sofar = useProject((state) => state.lesson?.rules ?? NONE);
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
  if (!sofar.length) return <p className={css.dim}>It stands here as soon as a step is shown on an asset.</p>;
  return (
    <>
      <p className={css.orient}>So far:</p>
      <Rows rules={sofar} accepted={false} learned />
    </>
  );
}

/** What was learned meanwhile, beside a program by hand. */
function Learned() {
  const rules = useProject((state) => (learnedDiffers(state.program, state.lesson) ? (state.lesson?.rules ?? NONE) : NONE));
  if (!rules.length) return null;
  return (
    <details className={css.learned}>
      <summary>What was learned in place of it</summary>
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
