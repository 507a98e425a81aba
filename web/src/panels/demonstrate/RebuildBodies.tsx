// Looking for hulls of all assets that hold more than one part, and making all hulls of their bodies anew.
import { Hammer, Search, Square } from "lucide-react";
import { cancelJob, rebuildBodies, useJob, whyNotRebuild } from "../../store/jobs";
import { useProject } from "../../store/project";
import { capitalize } from "../../store/words";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import type { Job } from "../../wire";
import { JobLines, JobNote } from "../review/JobProgress";
import css from "./demonstrate.module.css";

export function RebuildBodies() {
  const job = useJob("rebuild");
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
  const why = useProject(whyNotRebuild);
  return (
    <div className={css.spans}>
      {job && <JobNote job={job} />}
      <div className={css.buttons}>
        <Button icon={Search} disabled={why !== null} onClick={() => void rebuildBodies(true)} tip="Hulls of all assets that hold more than one part; nothing is changed">
          Find hulls that span parts
        </Button>
        <Button icon={Hammer} disabled={why !== null} onClick={() => void rebuildBodies(false)} tip="All hulls of each body in which one spans parts are made anew, each of one part; undo takes it back">
          Rebuild their bodies
        </Button>
      </div>
      {why !== null && <p className={css.hint}>{why}</p>}
      <JobLines lines={job?.lines ?? []} />
    </div>
  );
}
