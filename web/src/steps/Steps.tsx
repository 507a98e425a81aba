// The steps in order, after a first place that stands for the asset as it comes; arrow keys move between them.
import { type KeyboardEvent, useEffect, useRef } from "react";
import { show, useDesk } from "../store/desk";
import { useReorder } from "../ui/useReorder";
import type { AssetView } from "../wire";
import css from "./steps.module.css";
import { StepChip } from "./StepChip";
import { moveRule } from "./stepMenu";

export function Steps({ view, count }: { view: AssetView; count: number }) {
  const list = useRef<HTMLOListElement>(null);
  const reorder = useReorder("x", moveRule);
  const shown = useDesk(({ showing }) => (showing.kind === "steps" ? showing.steps : 0));
  useEffect(() => {
    list.current?.children[shown]?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }, [shown, count]);
  const source = useDesk(
    ({ showing }) => showing.kind === "source" || (showing.kind === "steps" && showing.steps === 0),
  );
  return (
    <ol
      ref={list}
      className={css.strip}
      aria-label="Steps of this asset"
      data-tour="steps"
      onKeyDown={(event) => arrows(event, list.current)}
    >
      <li className={css.chip} data-shown={source || undefined}>
        <button
          type="button"
          className={css.chipButton}
          aria-pressed={source}
          tabIndex={0}
          data-chip
          onClick={() => show({ kind: "source" })}
        >
          As it comes
        </button>
      </li>
      {Array.from({ length: count }, (_, place) => (
        <StepChip key={place} view={view} place={place} count={count} drag={reorder(place, place === count - 1)} />
      ))}
      {count === 0 && (
        <li className={css.empty}>Select hulls, then choose what happens to them: that is the first step.</li>
      )}
    </ol>
  );
}

/** Arrow keys go from chip to chip; Tab leaves them. */
function arrows(event: KeyboardEvent, list: HTMLElement | null): void {
  const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (by === undefined || event.altKey || !list) return;
  const chips = [...list.querySelectorAll<HTMLElement>("[data-chip]")];
  const here = chips.findIndex((chip) => chip === document.activeElement);
  event.preventDefault();
  chips[Math.min(Math.max(here + by, 0), chips.length - 1)]?.focus();
}
