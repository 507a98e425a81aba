// A job: its progress with the time that is left, a button that stops it, and what came of it.
import { Square } from "lucide-react";
import { cancelJob, progressText } from "../store/jobs";
import { capitalize } from "../store/words";
import { openAsset } from "../store/workspace";
import { useOwnNames } from "../store/project";
import { Button } from "./Button";
import { Name } from "./Name";
import { Note } from "./Section";
import type { Job, JobLine } from "../wire";
import css from "./jobs.module.css";

/** Jobs that compare all hulls once all are counted. */
const COMPARES: readonly Job["kind"][] = ["label", "rebuild"];

export function JobProgress({ job, unit }: { job: Job; unit?: string }) {
  const isCounted = job.done < job.total || !COMPARES.includes(job.kind);
  return (
    <div className={css.job}>
      <div className={css.head}>
        <span role="status">
          {isCounted && job.doing && `${capitalize(job.doing)}: `}
          {isCounted ? progressText(job, unit) : "Comparing all hulls…"}
        </span>
        <Button icon={Square} onClick={() => cancelJob(job.id)} aria-label={`Stop: ${job.title}`}>
          Stop
        </Button>
      </div>
      <progress value={isCounted ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </div>
  );
}

const MOODS = { running: "plain", done: "good", failed: "bad", cancelled: "warn" } as const;

/** How a job ended, in its own words; what could not be done for some assets, or is doubtful at any rate, is not good. */
export function JobNote({ job, doubtful = false }: { job: Job; doubtful?: boolean }) {
  const failed = doubtful || job.state === "done" && job.lines.some(({ status }) => status === "failed");
  return <Note mood={failed ? "warn" : MOODS[job.state]}>{job.message}</Note>;
}

const SIGNS: Readonly<Record<JobLine["status"], string>> = { done: "✓", edited: "✓", unchanged: "=", failed: "✗", skipped: "–" };

/** Results by asset in a job. */
export function JobLines({ lines }: { lines: readonly JobLine[] }) {
  const ownName = useOwnNames();
  if (!lines.length) return null;
  return (
    <ul className={css.jobLines} aria-label="Results by asset">
      {lines.map((line) => (
        <li key={line.asset}>
          <button type="button" data-status={line.status} title={`Open ${line.asset}`} onClick={() => openAsset(line.asset)}>
            <span aria-hidden>{SIGNS[line.status]}</span>
            <strong>
              <Name text={line.asset} own={ownName(line.asset)} />
            </strong>
            <span>
              {line.text || line.status}
              {line.before.map((text) => (
                <small key={text}>{text}</small>
              ))}
            </span>
          </button>
        </li>
      ))}
    </ul>
  );
}
