// The bottom of the window: the steps of the asset in hand, in order after the original asset, or, while reviewing,
// its edits by hand.
import { Undo2 } from "lucide-react";
import { type KeyboardEvent, useEffect, useRef } from "react";
import { perform } from "../store/edits";
import { clearStepHighlight, highlightStep } from "../store/highlight";
import { useProject } from "../store/project";
import { useAssetView } from "../store/scenes";
import { countText } from "../store/words";
import { show, useWorkspace } from "../store/workspace";
import { Button } from "../ui/Button";
import { moveFocusBy } from "../ui/moveFocusBy";
import { useReorder } from "../ui/useReorder";
import type { AssetView, ManualEditView } from "../wire";
import { ACTION_ICONS } from "./actionIcon";
import { StepChip } from "./StepChip";
import { moveRule } from "./stepMenu";
import css from "./steps.module.css";

export function StepStrip() {
  const stage = useWorkspace((workspace) => workspace.stage);
  const view = useAssetView();
  const rules = useProject((state) => state.project.rules.length);
  if (!view) return <div className={css.strip} />;
  if (stage === "review") return <Corrections view={view} />;
  const said = view.steps.filter((step) => step.select !== null).length;
  if (stage === "label") {
    return (
      <div className={css.line}>
        {said ? `${countText(said, "step")} shown on this asset` : "No steps on this asset yet"}
      </div>
    );
  }
  return <Steps view={view} count={Math.max(rules, view.steps.length)} />;
}

/** The steps in order, after a first place that stands for the original asset; arrow keys move between them. */
function Steps({ view, count }: { view: AssetView; count: number }) {
  const list = useRef<HTMLOListElement>(null);
  const reorder = useReorder("x", moveRule);
  const shown = useWorkspace(({ showing }) => (showing.kind === "steps" ? showing.steps : 0));
  useEffect(() => {
    list.current?.children[shown]?.scrollIntoView({ block: "nearest", inline: "nearest" });
  }, [shown, count]);
  const source = useWorkspace(
    ({ showing }) => showing.kind === "source" || (showing.kind === "steps" && showing.steps === 0),
  );
  return (
    <ol
      ref={list}
      className={css.strip}
      aria-label="Steps of this asset"
      data-tour="steps"
      onKeyDown={moveFocus}
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
          Original
        </button>
      </li>
      {Array.from({ length: count }, (_, place) => (
        <StepChip key={place} view={view} place={place} count={count} drag={reorder(place, place === count - 1)} />
      ))}
      {count === 0 && (
        <li className={css.empty}>Select hulls, then choose an action: this is the first step.</li>
      )}
    </ol>
  );
}

/** Arrow keys go from chip to chip; Tab leaves them. */
const moveFocus = (event: KeyboardEvent) => moveFocusBy(event, { ArrowLeft: -1, ArrowRight: 1 }, "[data-chip]");

/** The edits by hand of an asset, which are done again after the program. */
function Corrections({ view }: { view: AssetView }) {
  if (!view.manual_edits.length) {
    return <div className={css.line}>No edits by hand on this asset</div>;
  }
  return (
    <ol className={css.strip} aria-label="Edits by hand of this asset">
      <li className={css.title}>Edits by hand, after the program:</li>
      {view.manual_edits.map((correction, k) => (
        <Correction key={k} view={view} correction={correction} place={k} />
      ))}
      <li>
        <Button look="quiet" icon={Undo2} onClick={() => void perform({ kind: "drop-manual-edits", asset: view.asset })}>
          Revert to the program's result
        </Button>
      </li>
    </ol>
  );
}

function Correction({ view, correction, place }: { view: AssetView; correction: ManualEditView; place: number }) {
  const { short, label, icon } = correction.action;
  const Icon = ACTION_ICONS[icon];
  return (
    <li className={css.chip} onPointerEnter={() => highlightStep(view, correction.select)} onPointerLeave={clearStepHighlight}>
      <span className={css.chipButton} title={correction.select.join(", ")}>
        <span className={css.number}>{place + 1}</span>
        <Icon size={14} aria-hidden />
        <span className={css.action}>{short}</span>
        <span className={css.amount}>×{correction.select.length}</span>
        {label && <span className={css.made}>{label}</span>}
      </span>
    </li>
  );
}
