// Applying the program to all assets: the button, its progress, and what came of it.
import { Play } from "lucide-react";
import { applyTo, notApplicable } from "../../store/jobs";
import { useProject } from "../../store/project";
import { behind, grouped } from "../../store/reviews";
import { counted } from "../../store/words";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { JobProgress } from "./JobProgress";
import css from "./review.module.css";
import { Tally } from "./Tally";
import { useJob } from "./useJob";

export function ApplySection() {
  const job = useJob("apply");
  const running = job?.state === "running";
  return (
    <section className={css.apply} aria-label="Apply the program">
      {running ? <JobProgress job={job} unit="asset" /> : <Start />}
      {!running && job && job.state !== "done" && (
        <Note mood={job.state === "failed" ? "bad" : "warn"}>{job.message || "Applying was stopped; what was written stays."}</Note>
      )}
      <Tally />
    </section>
  );
}

function Start() {
  const why = useProject(notApplicable);
  const late = useProject((state) => behind(Object.values(state.cards)).length);
  const failed = useProject((state) => grouped(Object.values(state.cards)).failed.length);
  const some = useProject((state) => Object.values(state.cards).some((card) => card.output !== "none"));
  return (
    <div className={css.split}>
      <p>{why ?? said(late, failed, some)}</p>
      <Button look={late && !why ? "primary" : "plain"} icon={Play} disabled={why !== null} onClick={() => void applyTo(null)}>
        Apply to all
      </Button>
    </div>
  );
}

function said(late: number, failed: number, some: boolean): string {
  if (!late) return failed ? `Up to date; ${counted(failed, "asset")} failed.` : "All outputs are up to date.";
  if (!some) return `The program is ready for ${counted(late, "asset")}.`;
  return `${counted(late, "output")} ${late === 1 ? "is" : "are"} not up to date.`;
}
