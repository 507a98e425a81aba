// The review stage: apply the program, look at what came of it, accept, call wrong, exclude, correct, export.
import { Play } from "lucide-react";
import { useEffect, useMemo, useRef, useState } from "react";
import { SignOff } from "../../family/Sureness";
import { useCalled, useCalls } from "../../store/calls";
import { openText } from "../../store/goals";
import { applyTo, useJob, whyNotApply } from "../../store/jobs";
import { linesOfNew, newAssetsText, rebuildChoiceText, useRebuildChoice } from "../../store/newAssets";
import { useProject } from "../../store/project";
import { groupCards, listOutdated } from "../../store/reviews";
import { countText } from "../../store/words";
import { useLayout } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Check, Choice } from "../../ui/fields";
import type { Card, Job } from "../../wire";
import { Questions } from "../questions/Questions";
import { AssetReview } from "./AssetReview";
import { ExportSection } from "./ExportSection";
import { Goals } from "./Goals";
import { JobLines, JobNote, JobProgress } from "../../ui/JobProgress";
import { Results } from "./Results";
import css from "./review.module.css";

const PARTS = [
  { value: "asset", label: "This asset" },
  { value: "all", label: "All results" },
  { value: "goals", label: "Goals" },
  { value: "export", label: "Export" },
] as const;
type Part = (typeof PARTS)[number]["value"];

export function ReviewPanel() {
  const [part, setPart] = useState<Part>("asset");
  const place = useCalls((state) => state.place);
  useEffect(() => {
    if (place === "export") setPart(place); // its button then takes the call
  }, [place]);
  const hidden = useLayout((layout) => !layout.family && !layout.gallery);
  return (
    <div className={css.panel}>
      {hidden && <SignOff />}
      <Questions />
      <ApplySection />
      <div className={css.parts}>
        <Choice name="What to review" value={part} options={PARTS} onChange={setPart} />
      </div>
      <div className={css.part} data-part={part}>
        {part === "asset" && <AssetReview />}
        {part === "all" && <Results onOpen={() => setPart("asset")} />}
        {part === "goals" && <Goals onOpen={() => setPart("asset")} />}
        {part === "export" && <ExportSection />}
      </div>
    </div>
  );
}

/** Applying the program to all assets: the button, its progress, and what came of it. */
function ApplySection() {
  const job = useJob("apply");
  const running = job?.state === "running";
  return (
    <section className={css.apply} aria-label="Apply the program">
      {running ? <JobProgress job={job} unit="asset" /> : <Start />}
      {!running && <NewAssets />}
      {!running && job && <Outcome job={job} />}
      <OutputCounts />
    </section>
  );
}

/** Assets that a run prepares first, and whether it rebuilds bodies of theirs. */
function NewAssets() {
  const found = useProject((state) => state.project.new);
  const rebuild = useRebuildChoice((state) => state.rebuild);
  const choice = found && rebuildChoiceText(found);
  if (!found) return null;
  return (
    <div className={css.newAssets}>
      <p>{newAssetsText(found)}</p>
      {choice && (
        <Check checked={rebuild} onChange={(is) => useRebuildChoice.setState({ rebuild: is })}>
          {choice}
        </Check>
      )}
    </div>
  );
}

/** How the last run ended, and what was done to new assets before it. */
function Outcome({ job }: { job: Job }) {
  const goals = useProject((state) => job.state === "done" && openText(state) !== null);
  return (
    <>
      <JobNote job={job} doubtful={goals} />
      <JobLines lines={linesOfNew(job)} />
    </>
  );
}

function Start() {
  const why = useProject(whyNotApply);
  const late = useProject((state) => listOutdated(Object.values(state.cards)).length);
  const failed = useProject((state) => groupCards(Object.values(state.cards)).failed.length);
  const some = useProject((state) => Object.values(state.cards).some((card) => card.output !== "none"));
  const button = useRef<HTMLButtonElement>(null);
  useCalled("apply", () => button.current?.focus());
  return (
    <div className={css.split}>
      <p>{why ?? stateText(late, failed, some)}</p>
      <Button ref={button} look={late && !why ? "primary" : "plain"} icon={Play} disabled={why !== null} onClick={() => void applyTo(null)}>
        Apply to all
      </Button>
    </div>
  );
}

function stateText(late: number, failed: number, some: boolean): string {
  if (!late) return failed ? `Up to date; ${countText(failed, "asset")} failed.` : "All outputs are up to date.";
  if (!some) return `The program is ready for ${countText(late, "asset")}.`;
  return `${countText(late, "output")} ${late === 1 ? "is" : "are"} not up to date.`;
}

/** How many results there are of each kind. */
function OutputCounts() {
  const cards = useProject((state) => state.cards);
  const rows = useMemo(() => countOutputs(Object.values(cards)), [cards]);
  if (!rows.length) return null;
  return (
    <dl className={css.tally}>
      {rows.map(([what, count]) => (
        <div key={what} data-what={what} data-some={count > 0}>
          <dd>{count.toLocaleString("en-GB")}</dd>
          <dt>{what}</dt>
        </div>
      ))}
    </dl>
  );
}

function countOutputs(cards: readonly Card[]): (readonly [string, number])[] {
  const of = (output: Card["output"]) => cards.filter((card) => card.output === output).length;
  const { accepted, wrong, flagged } = groupCards(cards);
  const rows = [
    ["edited", of("edited")],
    ["unchanged", of("unchanged")],
    ["failed", of("failed")],
    ["wrong", wrong.length],
    ["flagged", flagged.length],
    ["accepted", accepted.length],
  ] as const;
  return of("none") === cards.length ? [] : rows.filter(([what, count]) => count > 0 || what === "edited" || what === "accepted");
}
