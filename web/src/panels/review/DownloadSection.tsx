// What the browser saves: a zip of the results, the report, and a turntable of before and after.
import { Download } from "lucide-react";
import { type ReactNode, useMemo, useState } from "react";
import { useJob } from "../../store/jobs";
import { useProject } from "../../store/project";
import { isSignedOff } from "../../store/reviews";
import { describeResults, listWritten, saveFile, takeAway } from "../../store/takeAway";
import { countText, shortName } from "../../store/words";
import { useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Choice } from "../../ui/fields";
import { Note, Section } from "../../ui/Section";
import type { Job } from "../../wire";
import css from "./download.module.css";
import { JobLines, JobProgress } from "./JobProgress";

const MOST_TURNING = 12;

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
  const written = useMemo(() => listWritten(family), [family]);
  const failed = family.some((card) => card.output === "failed");
  const nothing = written.length === 0;
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
      <Turntable written={written} busy={busy} />
    </ul>
  );
}

/** Either the asset that is open, or the first ones of the family. */
function Turntable({ written, busy }: { written: readonly string[]; busy: boolean }) {
  const open = useWorkspace((state) => state.asset);
  const here = open !== null && written.includes(open) ? open : null;
  const [wanted, setWanted] = useState<"this" | "first">("this");
  const [count, setCount] = useState(4);
  const of = here === null ? "first" : wanted;
  const most = Math.min(MOST_TURNING, written.length);
  const shown = Math.min(count, most);
  const options = [
    ...(here === null ? [] : [{ value: "this", label: "This asset" } as const]),
    { value: "first", label: "Several" } as const,
  ];
  return (
    <File
      name="Turntable"
      what="the turntable"
      busy={busy}
      disabled={most === 0}
      make={() => takeAway({ what: "turntable", ...(of === "this" ? { asset: here } : { count: shown }) })}
      more={
        <div className={css.turning}>
          <Choice name="Assets of the turntable" value={of} options={options} onChange={setWanted} />
          {of === "first" && (
            <label>
              first{" "}
              <input
                type="number"
                min={1}
                max={most}
                value={shown}
                onChange={(event) => setCount(Math.max(1, Math.min(most, Math.round(event.target.valueAsNumber) || 1)))}
              />{" "}
              of {written.length.toLocaleString("en-GB")}
            </label>
          )}
        </div>
      }
    >
      {of === "this" && here !== null ? `${shortName(here)}, before and after` : `${countText(shown, "asset")}, before and after`}, as a GIF
    </File>
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
  more?: ReactNode;
  children: ReactNode;
}

function File({ name, what, busy, disabled, make, more, children }: FileProps) {
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
      {more}
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
