// The family's rules as a list to tick off on the asset in hand, with a guess for those that are open.
import { Check, Circle, CircleDashed, CircleOff, Ellipsis } from "lucide-react";
import { useEffect } from "react";
import { runInTurn } from "../../commands/queue";
import { ACTION_ICONS } from "../../steps/actionIcon";
import { setStepHere, stepMenu } from "../../steps/stepMenu";
import { draftStep } from "../../store/draft";
import { acceptGuess, useGuesses } from "../../store/guesses";
import { clearStepHighlight, highlightStep } from "../../store/highlight";
import { useProject } from "../../store/project";
import { useAssetView } from "../../store/scenes";
import { amountText, openPlaces } from "../../store/steps";
import { countText } from "../../store/words";
import { useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import { Note, Section } from "../../ui/Section";
import type { AssetView, Guess, RuleLine } from "../../wire";
import css from "./demonstrate.module.css";

export function FamilyRules() {
  const rules = useProject((state) => state.project.rules);
  const view = useAssetView();
  const loading = useGuesses((state) => state.loading);
  const error = useGuesses((state) => state.error);
  if (!view || !rules.length) return null;
  const open = openPlaces(rules, view);
  const said = rules.length - open.length;
  return (
    <Section title="Rules of the family" aside={loading ? "guessing…" : `${said} of ${rules.length} demonstrated here`}>
      {error && open.length > 0 && <Note mood="warn">No guesses: {error}</Note>}
      <ol className={css.rules}>
        {rules.map((rule, place) => (
          <RuleRow key={rule.rule} rule={rule} place={place} view={view} rules={rules.length} isNext={place === open[0]} />
        ))}
      </ol>
      {!open.length && rules.length > 0 && (
        <p className={css.hint}>All rules are demonstrated on this asset. Demonstrate a different case on another asset.</p>
      )}
    </Section>
  );
}

interface RuleRowProps {
  rule: RuleLine;
  place: number;
  view: AssetView;
  rules: number;
  /** Whether it is the first that is open here. */
  isNext: boolean;
}

/** One rule on the asset in hand: shown, nothing here, or open, then with a guess to accept or to correct. */
function RuleRow({ rule, place, view, rules, isNext }: RuleRowProps) {
  const step = view.steps[place];
  const guess = useGuesses((state) =>
    state.asset === view.asset ? state.guesses.find((one) => one.rule === rule.rule) : undefined,
  );
  const inHand = useWorkspace((workspace) => workspace.draft?.editing === place);
  const isOpen = step?.select == null;
  const names = step?.select ?? guess?.select ?? [];
  useEffect(() => clearStepHighlight, []);
  const Icon = ACTION_ICONS[rule.action.icon];
  return (
    <li
      className={css.rule}
      data-in-hand={inHand || undefined}
      onPointerEnter={() => highlightStep(view, names, place)}
      onPointerLeave={clearStepHighlight}
    >
      <StepSign step={step} />
      <button
        type="button"
        className={css.ruleText}
        title={isOpen ? "Demonstrate it here" : "Change this step"}
        onClick={() => runInTurn(() => draftStep(place, isOpen ? guess?.select : undefined))}
        onFocus={() => highlightStep(view, names, place)}
        onBlur={clearStepHighlight}
      >
        <span className={css.number}>{rule.rule}</span>
        <Icon size={14} aria-hidden />
        <span className={css.code}>{(step ?? rule).action.text}</span>
        <span className={css.amount}>{amountText(step)}</span>
      </button>
      <Menu trigger={<IconButton icon={Ellipsis} name={`More for rule ${rule.rule}`} />} lines={stepMenu(view, place, rules)} />
      {step?.error && <p className={css.error}>{step.error}</p>}
      {isOpen && !inHand && <GuessLine guess={guess} view={view} place={place} isNext={isNext} />}
    </li>
  );
}

function StepSign({ step }: { step: AssetView["steps"][number] | undefined }) {
  if (step?.error) return <CircleOff size={15} className={css.bad} role="img" aria-label="cannot be replayed" />;
  if (step?.select == null) return <CircleDashed size={15} className={css.faint} role="img" aria-label="open" />;
  if (!step.select.length) return <Circle size={15} className={css.faint} role="img" aria-label="nothing here" />;
  return <Check size={15} className={css.good} role="img" aria-label="shown" />;
}

/** What the program would select for an open rule: to be accepted, corrected, or answered with nothing. */
function GuessLine({ guess, view, place, isNext }: Pick<RuleRowProps, "view" | "place" | "isNext"> & { guess: Guess | undefined }) {
  const sound = guess?.error === null ? guess : undefined;
  const count = sound?.select.length ?? 0;
  return (
    <div className={css.guess}>
      {guess?.error && <p className={css.hint}>No guess: {guess.error}</p>}
      {sound && <p title={sound.sentence}>Probably {count ? countText(count, "hull") : "nothing here"}</p>}
      <div className={css.buttons}>
        {sound && (
          <Button
            look={isNext ? "primary" : "plain"}
            keys={isNext ? "Enter" : undefined}
            tip="Take the guess as the step"
            onClick={() => runInTurn(() => acceptGuess(place + 1))}
          >
            Accept
          </Button>
        )}
        <Button onClick={() => runInTurn(() => draftStep(place, sound?.select))} tip="Select the hulls yourself">
          {count ? "Correct…" : "Demonstrate…"}
        </Button>
        {isNext && (count > 0 || !sound) && (
          <Button
            look="quiet"
            onClick={() => runInTurn(() => setStepHere(view.asset, place, []))}
            tip="The rule selects nothing on this asset"
          >
            Nothing here
          </Button>
        )}
      </div>
    </div>
  );
}
