// One step: its number, what it does to how many hulls, and the menu of what can be done with it.
import { Ellipsis, TriangleAlert } from "lucide-react";
import { type KeyboardEvent, useEffect } from "react";
import { runInTurn } from "../commands/queue";
import { draftStep } from "../store/draft";
import { clearStepHighlight, highlightStep } from "../store/highlight";
import { useProject } from "../store/project";
import { actionOf, amountText, removeStep } from "../store/steps";
import { select, show, useWorkspace } from "../store/workspace";
import { IconButton } from "../ui/Button";
import { Menu } from "../ui/Menu";
import type { AssetView, StepView } from "../wire";
import { ACTION_ICONS } from "./actionIcon";
import { moveRule, stepMenu } from "./stepMenu";
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
  const shown = useWorkspace(({ showing }) => showing.kind === "steps" && showing.steps === place + 1);
  const inHand = useWorkspace((workspace) => workspace.draft?.editing === place && workspace.stage === "demonstrate");
  const { text, short, label, icon } = step?.action ?? family ?? actionOf(place);
  useEffect(() => clearStepHighlight, []);
  const Icon = ACTION_ICONS[icon];
  const isOpen = step?.select == null;
  return (
    <li
      className={css.chip}
      data-open={isOpen || undefined}
      data-shown={shown || undefined}
      data-in-hand={inHand || undefined}
      data-error={step?.error ? true : undefined}
      onPointerEnter={() => highlightStep(view, step?.select ?? [], place)}
      onPointerLeave={clearStepHighlight}
      {...drag}
    >
      <button
        type="button"
        className={css.chipButton}
        aria-pressed={shown}
        data-chip
        tabIndex={-1}
        title={step?.error ?? (isOpen ? `${text}: not demonstrated here, so the program decides` : text)}
        onClick={({ detail }) => runInTurn(clickAction(detail, view, place))}
        onKeyDown={(event) => handleKey(event, view, place, count)}
      >
        <span className="visually-hidden">{`Step ${place + 1}: ${text}, ${amountText(step)}${step?.error ? `, ${step.error}` : ""}`}</span>
        <span className={css.number} aria-hidden>
          {place + 1}
        </span>
        {step?.error ? <TriangleAlert size={14} aria-hidden /> : <Icon size={14} aria-hidden />}
        <span className={css.action} aria-hidden>
          {short}
        </span>
        <span className={css.amount} aria-hidden>
          {amountText(step)}
        </span>
        {label && <MadeLabel label={label} />}
      </button>
      <Menu
        trigger={<IconButton icon={Ellipsis} name={`More for step ${place + 1}`} className={css.more} />}
        lines={stepMenu(view, place, count)}
      />
      {step?.error && <span className={css.error}>{step.error}</span>}
    </li>
  );
}

function MadeLabel({ label }: { label: string }) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === label)?.color);
  return (
    <span className={css.made} style={{ borderColor: color }} title={label} aria-hidden>
      {label}
    </span>
  );
}

/** What clicks on a step do: the first shows the asset after it, with what is left or made of its hulls selected; the second,
 * and the first on an open one, makes it the action in hand. */
export function clickAction(clicks: number, view: AssetView, place: number): () => unknown {
  const step = view.steps[place];
  if (step?.select == null || step.error) return () => (clicks > 1 ? undefined : draftStep(place));
  if (clicks === 2) return () => draftStep(place);
  return () => {
    if (clicks > 2) return;
    show({ kind: "steps", steps: place + 1 });
    select(hullsAfter(step));
  };
}

export function hullsAfter({ select: selected, made, removed }: StepView): string[] {
  const gone = new Set(removed);
  return [...(selected ?? []).filter((name) => !gone.has(name)), ...made];
}

function handleKey(event: KeyboardEvent, view: AssetView, place: number, count: number): void {
  const act = keyAction(event, view, place, count);
  if (!act) return;
  event.preventDefault();
  act();
}

export function keyAction(event: KeyboardEvent, view: AssetView, place: number, count: number): (() => void) | null {
  if (event.key === "Enter") return () => runInTurn(() => draftStep(place));
  if (event.key === "Delete" || event.key === "Backspace") return () => void removeStep(view.asset, place);
  if (event.altKey && event.key === "ArrowLeft" && place > 0) return () => moveRule(place, place - 1);
  if (event.altKey && event.key === "ArrowRight" && place < count - 1) return () => moveRule(place, place + 1);
  return null;
}
