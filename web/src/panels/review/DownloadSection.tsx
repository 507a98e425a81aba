// What the browser saves: a zip of the results, and the report.
import { Download } from "lucide-react";
import { type ReactNode, useMemo } from "react";
import { useJob } from "../../store/jobs";
import { useProject } from "../../store/project";
import { isSignedOff, isWritten } from "../../store/reviews";
import { describeResults, saveFile, takeAway } from "../../store/takeAway";
import { Button } from "../../ui/Button";
import { Note, Section } from "../../ui/Section";
import type { Job } from "../../wire";
import css from "./download.module.css";
import { JobLines, JobProgress } from "./JobProgress";

export function DownloadSection({ signedOnly }: { signedOnly: boolean }) {
  const job = useJob("download");
  const running = job?.state === "running";
  return (
    <Section title="Download">
      <Files signedOnly={signedOnly} busy={running} />
      {running && <Progress job={job} />}
      <div role="status">{job && !running && <Outcome job={job} />}</div>
    </Section>
  );
}

function Progress({ job }: { job: Job }) {
  return (
    <div className={css.progress}>
      <p>{job.title}</p>
      <JobProgress job={job} unit="step" />
    </div>
  );
}

function Files({ signedOnly, busy }: { signedOnly: boolean; busy: boolean }) {
  const cards = useProject((state) => state.cards);
  const order = useProject((state) => state.order);
  const confidence = useProject((state) => state.confidence);
  const family = useMemo(() => order.flatMap((asset) => cards[asset] ?? []), [order, cards]);
  const failed = family.some((card) => card.output === "failed");
  const nothing = !family.some(isWritten);
  const noneSigned = signedOnly && !family.some((card) => isSignedOff(card, confidence[card.asset]));
  if (nothing && !failed) return <p className={css.dim}>Nothing is written yet: apply the program.</p>;
  return (
    <ul className={css.files}>
      <File
        name="Results"
        what="the results"
        busy={busy}
        disabled={nothing || noneSigned}
        make={() => takeAway({ what: "results", signed_only: signedOnly })}
      >
        {noneSigned ? "Nothing that is written is signed off yet" : describeResults(family, confidence, signedOnly)}
      </File>
      <File name="Report" what="the report" busy={busy} disabled={false} make={() => takeAway({ what: "report" })}>
        One HTML page: pictures, figures, and how sure each is
      </File>
    </ul>
  );
}

interface FileProps {
  name: string;
  /** What is downloaded, for screen readers. */
  what: string;
  /** Whether another file is being made: the button keeps the focus meanwhile, and does nothing. */
  busy: boolean;
  disabled: boolean;
  make: () => Promise<void>;
  children: ReactNode;
}

function File({ name, what, busy, disabled, make, children }: FileProps) {
  return (
    <li className={css.file}>
      <div className={css.text}>
        <strong>{name}</strong>
        <p className={css.dim}>{children}</p>
      </div>
      <Button
        icon={Download}
        aria-label={`Download ${what}`}
        disabled={disabled}
        aria-disabled={busy || disabled}
        onClick={() => {
          if (!busy) void make();
        }}
      >
        Download
      </Button>
    </li>
  );
}

function Outcome({ job }: { job: Job }) {
  const broken = job.lines.some((line) => line.status === "failed");
  const moods = { done: broken ? "warn" : "plain", failed: "bad", cancelled: "warn", running: "plain" } as const;
  return (
    <div className={css.outcome}>
      <Note mood={moods[job.state]}>{job.message}</Note>
      {job.state === "done" && job.out && (
        <div className={css.saved}>
          <code>{job.out}</code>
          <Button look="quiet" icon={Download} onClick={() => void saveFile(job.id)}>
            Save again
          </Button>
        </div>
      )}
      <JobLines lines={job.lines} />
    </div>
  );
}
