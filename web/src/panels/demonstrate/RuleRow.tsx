// One rule on the asset in hand: shown, nothing here, or open, then with a guess to accept or to correct.
import { Check, Circle, CircleDashed, CircleOff, Ellipsis } from "lucide-react";
import { useEffect } from "react";
import { inTurn } from "../../commands/turns";
import { useDesk } from "../../store/desk";
import { draftStep } from "../../store/beginning";
import { useGuesses } from "../../store/guesses";
import { light, unlight } from "../../store/lighting";
import { amount } from "../../store/stepWords";
import { actionIcon } from "../../steps/actionLooks";
import { stepLines } from "../../steps/stepMenu";
import { IconButton } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import type { AssetView, RuleLine } from "../../wire";
import css from "./demonstrate.module.css";
import { GuessLine } from "./GuessLine";

interface RuleRowProps {
  rule: RuleLine;
  place: number;
  view: AssetView;
  rules: number;
  /** Whether it is the first that is open here. */
  isNext: boolean;
}

export function RuleRow({ rule, place, view, rules, isNext }: RuleRowProps) {
  const step = view.steps[place];
  const guess = useGuesses((state) =>
    state.asset === view.asset ? state.guesses.find((one) => one.rule === rule.rule) : undefined,
  );
  const inHand = useDesk((desk) => desk.draft?.editing === place);
  const isOpen = step?.select == null;
  const names = step?.select ?? guess?.select ?? [];
  useEffect(() => unlight, []);
  const Icon = actionIcon(rule.action);
  return (
    <li
      className={css.rule}
      data-in-hand={inHand || undefined}
      onPointerEnter={() => light(view, names, place)}
      onPointerLeave={unlight}
    >
      <State step={step} />
      <button
        type="button"
        className={css.ruleText}
        title={isOpen ? "Show it here" : "Change what is shown here"}
        onClick={() => inTurn(() => draftStep(place, isOpen ? guess?.select : undefined))}
        onFocus={() => light(view, names, place)}
        onBlur={unlight}
      >
        <span className={css.number}>{rule.rule}</span>
        <Icon size={14} aria-hidden />
        <span className={css.code}>{step?.action ?? rule.action}</span>
        <span className={css.amount}>{amount(step)}</span>
      </button>
      <Menu
        trigger={<IconButton icon={Ellipsis} name={`More for rule ${rule.rule}`} />}
        lines={stepLines(view, place, rules)}
      />
      {step?.error && <p className={css.error}>{step.error}</p>}
      {isOpen && !inHand && <GuessLine guess={guess} view={view} place={place} isNext={isNext} />}
    </li>
  );
}

function State({ step }: { step: AssetView["steps"][number] | undefined }) {
  if (step?.error) return <CircleOff size={15} className={css.bad} role="img" aria-label="cannot be replayed" />;
  if (step?.select == null) return <CircleDashed size={15} className={css.faint} role="img" aria-label="open" />;
  if (!step.select.length) return <Circle size={15} className={css.faint} role="img" aria-label="nothing here" />;
  return <Check size={15} className={css.good} role="img" aria-label="shown" />;
}
