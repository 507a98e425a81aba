// Checking all results: the button, its progress, and what came of it.
import { ArrowDownWideNarrow, Gauge } from "lucide-react";
import { countUnchecked } from "../../store/checks";
import { checkAll, useJob, whyNotCheck } from "../../store/jobs";
import { useProject } from "../../store/project";
import { setFilters, useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { JobLines, JobProgress } from "../../ui/JobProgress";

export function CheckAll() {
  const job = useJob("check");
  const why = useProject(whyNotCheck);
  const left = useProject((state) => countUnchecked(Object.values(state.cards)));
  if (job?.state === "running") return <JobProgress job={job} unit="result" />;
  const broken = job?.lines.filter((line) => line.status === "failed") ?? [];
  return (
    <>
      {left > 0 ? (
        <Button
          icon={Gauge}
          disabled={why !== null}
          tip="Fit, free space, rest and engine limits, compared with the original assets; seconds for each result, in the background"
          onClick={() => void checkAll()}
        >
          Check all results ({left} to do)
        </Button>
      ) : (
        why === null && <WorstFirst />
      )}
      {job && (job.state !== "done" || broken.length > 0) && (
        <Note mood={job.state === "cancelled" ? "plain" : "warn"}>
          {job.message}
          <JobLines lines={broken} />
        </Note>
      )}
    </>
  );
}

/** Once all are checked: the family by what was found. */
function WorstFirst() {
  const on = useWorkspace((workspace) => workspace.filters.sort === "findings");
  return (
    <Button icon={ArrowDownWideNarrow} aria-pressed={on} onClick={() => setFilters({ sort: on ? "name" : "findings", chosen: true })}>
      {on ? "Family by name again" : "All are checked: worst first in the family"}
    </Button>
  );
}
