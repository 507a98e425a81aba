// One step: its number, what it does to how many hulls, and the menu of what can be done with it.
import { Ellipsis, TriangleAlert } from "lucide-react";
import { type KeyboardEvent, useEffect } from "react";
import { inTurn } from "../commands/turns";
import { select, show, useDesk } from "../store/desk";
import { draftStep } from "../store/beginning";
import { light, unlight } from "../store/lighting";
import { useProject } from "../store/project";
import { actionOf } from "../store/steps";
import { amount, splitAction } from "../store/stepWords";
import { IconButton } from "../ui/Button";
import { Menu } from "../ui/Menu";
import type { AssetView, StepView } from "../wire";
import { actionIcon } from "./actionLooks";
import { moveRule, stepLines, takeAway } from "./stepMenu";
import css from "./steps.module.css";

interface StepChipProps {
  view: AssetView;
  place: number;
  count: number;
  drag: object;
}

export function StepChip({ view, place, count, drag }: StepChipProps) {
  const step = view.steps[place];
  const family = useProject((state) => state.project.rules[place]?.action);
  const shown = useDesk(({ showing }) => showing.kind === "steps" && showing.steps === place + 1);
  const inHand = useDesk((desk) => desk.draft?.editing === place && desk.stage === "demonstrate");
  const text = step?.action ?? family ?? actionOf(place);
  const { action, label } = splitAction(text);
  useEffect(() => unlight, []);
  const Icon = actionIcon(text);
  const isOpen = step?.select == null;
  return (
    <li
      className={css.chip}
      data-open={isOpen || undefined}
      data-shown={shown || undefined}
      data-in-hand={inHand || undefined}
      data-error={step?.error ? true : undefined}
      onPointerEnter={() => light(view, step?.select ?? [], place)}
      onPointerLeave={unlight}
      {...drag}
    >
      <button
        type="button"
        className={css.chipButton}
        aria-pressed={shown}
        aria-label={`Step ${place + 1}: ${text}, ${amount(step)}${step?.error ? `, ${step.error}` : ""}`}
        data-chip
        tabIndex={-1}
        title={step?.error ?? (isOpen ? `${text}: nothing is said here, so that the program decides` : text)}
        onClick={() => open(view, place)}
        onKeyDown={(event) => keyed(event, view, place, count)}
      >
        <span className={css.number}>{place + 1}</span>
        {step?.error ? <TriangleAlert size={14} aria-hidden /> : <Icon size={14} aria-hidden />}
        <span className={css.action}>{action}</span>
        <span className={css.amount}>{amount(step)}</span>
        {label && <Made label={label} />}
      </button>
      <Menu
        trigger={<IconButton icon={Ellipsis} name={`More for step ${place + 1}`} className={css.more} />}
        lines={stepLines(view, place, count)}
      />
      {step?.error && <span className={css.error}>{step.error}</span>}
    </li>
  );
}

function Made({ label }: { label: string }) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === label)?.color);
  return (
    <span className={css.made} style={{ borderColor: color }}>
      {label}
    </span>
  );
}

/** Shows the asset after a step, with what is left or made of its hulls selected; an open one is taken into the hand. */
function open(view: AssetView, place: number): void {
  const step = view.steps[place];
  if (step?.select == null || step.error) return inTurn(() => draftStep(place));
  show({ kind: "steps", steps: place + 1 });
  select(after(step));
}

function after({ select: selected, made, removed }: StepView): string[] {
  const gone = new Set(removed);
  return [...(selected ?? []).filter((name) => !gone.has(name)), ...made];
}

function keyed(event: KeyboardEvent, view: AssetView, place: number, count: number): void {
  const act = meant(event, view, place, count);
  if (!act) return;
  event.preventDefault();
  act();
}

function meant(event: KeyboardEvent, view: AssetView, place: number, count: number): (() => void) | null {
  if (event.key === "Enter") return () => inTurn(() => draftStep(place));
  if (event.key === "Delete" || event.key === "Backspace") return () => takeAway(view.asset, place);
  if (event.altKey && event.key === "ArrowLeft" && place > 0) return () => moveRule(place, place - 1);
  if (event.altKey && event.key === "ArrowRight" && place < count - 1) return () => moveRule(place, place + 1);
  return null;
}
