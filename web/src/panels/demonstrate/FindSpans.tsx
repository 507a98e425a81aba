// Looking for hulls of all assets that hold more than one part, which the card of questions asks about then.
import { CircleQuestionMark, Split, Square } from "lucide-react";
import { goToCard } from "../../commands/question";
import { openQuestion } from "../../store/assessment";
import { countSpans } from "../../store/hullParts";
import { cancelJob, findSpans, useJob, whyNotFindSpans } from "../../store/jobs";
import { useProject } from "../../store/project";
import { capitalize } from "../../store/words";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import type { Job, JobLine } from "../../wire";
import { JobLines, JobNote } from "../review/JobProgress";
import css from "./demonstrate.module.css";

export function FindSpans() {
  const job = useJob("spans");
  return (
    <Section title="Prepare all assets">
      {job?.state === "running" ? <Running job={job} /> : <Ready job={job} />}
    </Section>
  );
}

function Running({ job }: { job: Job }) {
  const counts = job.done < job.total;
  return (
    <div className={css.buttons}>
      <span role="status">{counts ? `${capitalize(job.doing)}: ${job.done} of ${job.total}` : "Comparing all hulls…"}</span>
      <Button icon={Square} onClick={() => cancelJob(job.id)} aria-label="Stop looking for hulls that span parts">
        Stop
      </Button>
      <progress className={css.progress} value={counts ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </div>
  );
}

function Ready({ job }: { job: Job | null }) {
  const why = useProject(whyNotFindSpans);
  const isAsked = useProject((state) => openQuestion(state)?.kind === "span");
  const left = useProject(({ cards }) => countSpans(cards));
  const isFound = (line: JobLine) => line.status === "done";
  // once all hulls are split, or said to be one part, what was found is not so any more
  const isOver = left === 0 && job?.lines.some(isFound);
  const lines = job?.lines.filter((line) => left > 0 || !isFound(line)) ?? [];
  return (
    <div className={css.spans}>
      {job && !isOver && <JobNote job={job} />}
      <div className={css.buttons}>
        <Button icon={Split} disabled={why !== null} onClick={() => void findSpans()} tip="Hulls of all assets that hold more than one part">
          Find hulls that span parts
        </Button>
        {isAsked && (
          <Button icon={CircleQuestionMark} onClick={goToCard} keys="U">
            Go to the question
          </Button>
        )}
      </div>
      {why !== null && <p className={css.hint}>{why}</p>}
      <JobLines lines={lines} />
    </div>
  );
}
