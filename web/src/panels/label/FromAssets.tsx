// Labels carried over from the assets that a person or a file has labelled to all others.
import { ArrowRight, Square, Waypoints } from "lucide-react";
import { openAsset, useDesk } from "../../store/desk";
import { cancelJob, carryOver, notCarriable } from "../../store/jobs";
import { useProject } from "../../store/project";
import { givenLabels } from "../../store/unsure";
import { counted } from "../../store/words";
import type { Job } from "../../wire";
import { Button, IconButton } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { useJob } from "../review/useJob";
import { Way } from "./Way";
import css from "./ways.module.css";

const TITLE = "From labelled assets";

export function FromAssets() {
  const job = useJob("propagate");
  if (job?.state === "running") return <Running job={job} />;
  return <Ready job={job} />;
}

function Ready({ job }: { job: Job | null }) {
  const why = useProject(notCarriable);
  const given = useGiven();
  const carried = useProject((state) => state.project.carried);
  const unused = carried?.unused ?? 0;
  const carry = (
    <Button
      look={why === null && (!carried || unused > 0) ? "primary" : "plain"}
      disabled={why !== null}
      onClick={() => void carryOver()}
      aria-label={carried ? "Carry labels over again" : "Carry labels over"}
      tip="Label all other hulls as those that are most like them"
      keys="P"
    >
      {carried ? "Carry over again" : "Carry over"}
    </Button>
  );
  const text = why ?? (carried ? sinceThen(unused) : given);
  return (
    <Way icon={Waypoints} title={TITLE} text={text} action={carry}>
      {job?.state === "failed" && <Note mood="bad">{job.message}</Note>}
      {job?.state === "cancelled" && <Note mood="warn">{job.message}</Note>}
      {carried?.next && <Best asset={carried.next} />}
    </Way>
  );
}

const sinceThen = (unused: number): string =>
  unused ? `${counted(unused, "label")} not used yet` : "All you labelled is used";

function useGiven(): string {
  const { given, assets } = givenLabels(useProject((state) => state.cards));
  return `${counted(given, "label")} on ${counted(assets, "asset")}`;
}

/** The asset that would help most if it were labelled. */
function Best({ asset }: { asset: string }) {
  const isOpen = useDesk((desk) => desk.asset === asset);
  return (
    <div className={css.best}>
      <span title={`${asset} would help most if it were labelled`}>
        Best labelled next: <b>{asset}</b>
      </span>
      {!isOpen && (
        <IconButton icon={ArrowRight} name={`Open ${asset}, and label it`} onClick={() => openAsset(asset)} />
      )}
    </div>
  );
}

/** Reading can be counted; comparing all hulls cannot. */
function Running({ job }: { job: Job }) {
  const reading = job.done < job.total;
  const text = reading ? `Reading assets: ${job.done} of ${job.total}` : "Comparing all hulls…";
  const stop = (
    <Button icon={Square} onClick={() => cancelJob(job.id)} aria-label="Stop carrying labels over">
      Stop
    </Button>
  );
  return (
    <Way icon={Waypoints} title={TITLE} text={<span role="status">{text}</span>} action={stop}>
      <progress className={css.progress} value={reading ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </Way>
  );
}
