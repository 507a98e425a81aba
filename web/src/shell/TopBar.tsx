// The bar above: project, search, undo and redo, what works in the background, theme, help.
import { CircleQuestionMark, FolderOpen, PanelLeftOpen, Search } from "lucide-react";
import { Popover } from "radix-ui";
import type { ReactNode } from "react";
import { cancelJob, progressText } from "../store/jobs";
import { leaveProject } from "../store/start";
import { useProject } from "../store/project";
import { useToasts } from "../store/toasts";
import { setLayout, useLayout, useWorkspace } from "../store/workspace";
import { Button, IconButton } from "../ui/Button";
import { JobLines } from "../ui/JobProgress";
import { ThemeMenu } from "../ui/ThemeMenu";
import { Wordmark } from "../ui/Wordmark";
import type { Job } from "../wire";
import { History } from "./History";
import css from "./TopBar.module.css";

export function TopBar() {
  const { name, folder } = useProject((state) => state.project);
  const hidden = useLayout((layout) => !layout.family && !layout.gallery);
  const leave = useProject((state) => state.leave);
  return (
    <header className={css.bar} data-part>
      {hidden && (
        <IconButton icon={PanelLeftOpen} name="Show the family" keys="F9" onClick={() => setLayout({ family: true })} />
      )}
      <Wordmark />
      <span className={css.line} aria-hidden />
      <h1 className={css.name} title={folder}>
        {name}
      </h1>
      {leave && <IconButton icon={FolderOpen} name="Projects: leave this one for the start page" onClick={() => void leaveProject()} />}
      <button type="button" className={css.search} onClick={() => useWorkspace.setState({ overlay: "palette" })}>
        <Search size={14} aria-hidden />
        <span>Find a command or an asset</span>
        <kbd>Ctrl+K</kbd>
      </button>
      <History />
      <span className={css.space} />
      <Learning />
      <Problems />
      <Jobs />
      <ThemeMenu />
      <IconButton icon={CircleQuestionMark} name="Keys and help" keys="?" onClick={() => useWorkspace.setState({ overlay: "help" })} />
    </header>
  );
}

function Learning() {
  const learning = useProject((state) => state.learning);
  return (
    <span role="status" className={css.learning}>
      {learning && (
        <span className={css.late}>
          <span className={css.spinner} aria-hidden /> Learning…
        </span>
      )}
    </span>
  );
}

/** What went wrong of late, also what is not shown any more. */
function Problems() {
  const problems = useToasts((state) => state.problems);
  if (problems.length === 0) return null;
  return (
    <Drop name="Problems" trigger={`Problems ${problems.length}`}>
      {problems.map(({ id, at, text, remedy }) => (
        <li key={id} className={css.job}>
          <p>
            <time dateTime={at.toISOString()}>{at.toLocaleTimeString("en-GB")}</time> {text}
          </p>
          {remedy && <p className={css.message}>{remedy}</p>}
        </li>
      ))}
    </Drop>
  );
}

/** Work that takes long: how far it is, what came of it, and stopping it. */
function Jobs() {
  const jobs = useProject((state) => state.jobs);
  if (jobs.length === 0) return null;
  const running = jobs.filter((job) => job.state === "running");
  const [first] = running;
  const latest = jobs[jobs.length - 1];
  const trigger = first ? (
    <>
      {first.title}
      <progress value={first.total ? first.done : undefined} max={first.total || 1} aria-label={first.title} />
      {first.total > 0 && progressText(first)}
      {running.length > 1 && ` +${running.length - 1}`}
    </>
  ) : (
    <>
      <Sign state={latest?.state ?? "done"} /> Jobs
    </>
  );
  return (
    <Drop name="Jobs" trigger={trigger}>
      {[...jobs].reverse().map((job) => (
        <JobRow key={job.id} job={job} />
      ))}
    </Drop>
  );
}

/** A list that opens below the bar. */
function Drop({ name, trigger, children }: { name: string; trigger: ReactNode; children: ReactNode }) {
  return (
    <Popover.Root>
      <Popover.Trigger className={css.jobButton}>{trigger}</Popover.Trigger>
      <Popover.Portal>
        <Popover.Content className={css.jobs} align="end" sideOffset={5} aria-label={name}>
          <ul>{children}</ul>
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
        {job.total > 0 && progressText(job)}
        {job.state === "running" && job.kind !== "read" && (
          <Button onClick={() => cancelJob(job.id)}>Stop</Button>
        )}
      </div>
      {job.state === "running" && (
        <progress value={job.total ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
      )}
      {job.message && <p className={css.message}>{job.message}</p>}
      <JobLines lines={job.lines} />
    </li>
  );
}
