// The goals of the family: each in words, how many results it holds on, and the form of one.
import { Pencil, Play, Plus, Trash2 } from "lucide-react";
import { useMemo } from "react";
import { perform } from "../../store/edits";
import { countGoal, startGoal, useGoalDraft } from "../../store/goals";
import { applyTo, whyNotApply } from "../../store/jobs";
import { useProject } from "../../store/project";
import { visit } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Section } from "../../ui/Section";
import type { GoalView } from "../../wire";
import { GoalForm } from "./GoalForm";
import css from "./goals.module.css";
import review from "./review.module.css";

export function Goals({ onOpen }: { onOpen: () => void }) {
  const goals = useProject((state) => state.project.goals);
  const draft = useGoalDraft((state) => state.draft);
  const isChange = goals.some(({ name }) => name === draft?.was); // else it is new, or was removed meanwhile
  return (
    <Section title="What assets must do" aside={goals.length > 0 && `${goals.length}`}>
      {!goals.length && !draft && (
        <p className={review.dim}>
          A goal says what works on every asset after the edit: it stands, a drawer holds something, a handle can be gripped. MuJoCo tries it. Without goals
          nothing is tried.
        </p>
      )}
      <ul className={css.goals} aria-label="Goals">
        {goals.map((goal) => (
          <li key={goal.name}>{draft?.was === goal.name ? <GoalForm draft={draft} /> : <Goal goal={goal} onOpen={onOpen} />}</li>
        ))}
      </ul>
      {draft ? (
        !isChange && <GoalForm draft={draft} />
      ) : (
        <Button icon={Plus} look={goals.length ? "plain" : "primary"} onClick={() => startGoal()}>
          New goal
        </Button>
      )}
    </Section>
  );
}

function Goal({ goal, onOpen }: { goal: GoalView; onOpen: () => void }) {
  const { name, text, sentence, error } = goal;
  return (
    <section aria-label={name} className={css.goal}>
      <header className={review.split}>
        <strong>{name}</strong>
        <span>
          <IconButton icon={Pencil} name={`Change ${name}`} onClick={() => startGoal(goal)} />
          <IconButton icon={Trash2} name={`Remove ${name}`} onClick={() => void perform({ kind: "goal", name, text: null })} />
        </span>
      </header>
      {error ? <pre className={css.error}>{error}</pre> : <p>{sentence}</p>}
      <code className={review.code}>{text}</code>
      {!error && <Counts name={name} onOpen={onOpen} />}
    </section>
  );
}

/** On how many results a goal holds, fails, does not apply, or was not tried. */
function Counts({ name, onOpen }: { name: string; onOpen: () => void }) {
  const cards = useProject((state) => state.cards);
  const { holds, fails, accepted, away, untried } = useMemo(() => countGoal(Object.values(cards), name), [cards, name]);
  const why = useProject(whyNotApply);
  const [first] = fails;
  const show = () => {
    if (first !== undefined) visit(first, { kind: "result", of: "output" });
    onOpen();
  };
  return (
    <div className={review.row}>
      <span className={holds ? review.good : review.dim}>holds on {holds}</span>
      {first !== undefined && (
        <Button look="danger" tip={`Show the first: ${first}`} onClick={show}>
          fails on {fails.length}
        </Button>
      )}
      {accepted > 0 && <span>accepted on {accepted}</span>}
      {away > 0 && <span className={review.dim}>does not apply to {away}</span>}
      {untried > 0 && (
        <>
          <span className={review.warn}>not tried on {untried}</span>
          <Button icon={Play} disabled={why !== null} tip={why ?? "Applies the program where it is not up to date, and tries all goals"} onClick={() => void applyTo(null)}>
            Try
          </Button>
        </>
      )}
    </div>
  );
}
