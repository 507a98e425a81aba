// Work that takes long: how far it is, what came of it, and stopping it.
import { Popover } from "radix-ui";
import { api } from "../server/api";
import { useProject } from "../store/project";
import { complainedOf } from "../store/toasts";
import { Button } from "../ui/Button";
import type { Job } from "../wire";
import css from "./TopBar.module.css";

export function Jobs() {
  const jobs = useProject((state) => state.jobs);
  if (jobs.length === 0) return null;
  const running = jobs.filter((job) => job.state === "running");
  const [first] = running;
  const latest = jobs[jobs.length - 1];
  return (
    <Popover.Root>
      <Popover.Trigger className={css.jobButton}>
        {first ? (
          <>
            {first.title}
            <progress value={first.total ? first.done : undefined} max={first.total || 1} aria-label={first.title} />
            {first.total > 0 && `${first.done}/${first.total}`}
            {running.length > 1 && ` +${running.length - 1}`}
          </>
        ) : (
          <>
            <Sign state={latest?.state ?? "done"} /> Jobs
          </>
        )}
      </Popover.Trigger>
      <Popover.Portal>
        <Popover.Content className={css.jobs} align="end" sideOffset={5} aria-label="Jobs">
          <ul>
            {[...jobs].reverse().map((job) => (
              <JobRow key={job.id} job={job} />
            ))}
          </ul>
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}

const SIGNS = { running: "…", done: "✓", failed: "✗", cancelled: "–" } as const;
const WORDS = { running: "running", done: "done", failed: "failed", cancelled: "stopped" } as const;

function Sign({ state }: { state: Job["state"] }) {
  return (
    <span role="img" aria-label={WORDS[state]}>
      {SIGNS[state]}
    </span>
  );
}

function JobRow({ job }: { job: Job }) {
  return (
    <li className={css.job}>
      <div className={css.jobHead}>
        <Sign state={job.state} />
        <span className={css.jobTitle}>{job.title}</span>
        {job.total > 0 && `${job.done} of ${job.total}`}
        {job.state === "running" && job.kind !== "read" && (
          <Button onClick={() => void api.cancelJob(job.id).catch(complainedOf)}>Stop</Button>
        )}
      </div>
      {job.state === "running" && (
        <progress value={job.total ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
      )}
      {job.message && <p className={css.message}>{job.message}</p>}
      {job.lines.length > 0 && (
        <ul className={css.lines} tabIndex={0} aria-label="What became of the assets">
          {job.lines.map((line) => (
            <li key={line.asset} data-status={line.status}>
              <b>{line.asset}</b> {line.status}
              {line.text && `: ${line.text}`}
            </li>
          ))}
        </ul>
      )}
    </li>
  );
}
