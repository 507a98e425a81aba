// The way to get labels other than by hand, with what it would use.
import { ArrowRight, Square, Waypoints } from "lucide-react";
import { type ReactNode, useMemo } from "react";
import { cancelJob, labelAll, useJob, whyNotLabel } from "../../store/jobs";
import { labelsWithoutHull } from "../../store/labels";
import { useFreshSources, useLabelSources } from "../../store/labelSources";
import { labelProgress } from "../../store/labelWalk";
import { useProject } from "../../store/project";
import { capitalize, countText, shortName } from "../../store/words";
import { openAsset } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Note, Section } from "../../ui/Section";
import type { Job } from "../../wire";
import { JobLines, JobNote } from "../review/JobProgress";
import css from "./getLabels.module.css";

export function GetLabels() {
  useFreshSources();
  return (
    <Section title="Get labels">
      <ul className={css.ways}>
        <FromAll />
      </ul>
    </Section>
  );
}

interface SourceRowProps {
  /** What it would give, or why it gives nothing. */
  text: ReactNode;
  action: ReactNode;
  /** What there is more to tell, below. */
  children?: ReactNode;
}

/** Labels from files, names, and the labels that there are: what there is, and the button that does it. */
function SourceRow({ text, action, children }: SourceRowProps) {
  return (
    <li className={css.way}>
      <Waypoints size={16} aria-hidden className={css.sign} />
      <div className={css.words}>
        <span className={css.title}>From all that is there</span>
        <span className={css.text}>{text}</span>
      </div>
      {action}
      {children && <div className={css.more}>{children}</div>}
    </li>
  );
}

/** Labels from files, names, and the labels that there are, weighed together. */
function FromAll() {
  const job = useJob("label");
  if (job?.state !== "running") return <LabelReady job={job} />;
  const counted = job.done < job.total; // comparing all hulls cannot be counted
  const text = counted ? `${capitalize(job.doing || "reading")}: ${job.done} of ${job.total}` : "Comparing all hulls…";
  return <Running job={job} counted={counted} text={text} />;
}

function LabelReady({ job }: { job: Job | null }) {
  const why = useProject(whyNotLabel);
  const propagation = useProject((state) => state.project.propagation);
  const there = useSourceTexts();
  const [cards, vocabulary] = [useProject((state) => state.cards), useProject((state) => state.project.vocabulary)];
  const missing = useMemo(() => labelsWithoutHull(cards, vocabulary), [cards, vocabulary]);
  const label = (
    <Button
      look={why === null && there.length > 0 ? "primary" : "plain"}
      disabled={why !== null}
      onClick={() => void labelAll()}
      tip="Label all hulls from files, names, and the labelled hulls that they resemble"
      keys="P"
    >
      <span>
        Label<span className="visually-hidden"> all hulls</span>
        {propagation && " again"}
      </span>
    </Button>
  );
  const lost = job?.lines.filter(({ status }) => status === "failed") ?? [];
  const isPresent = job?.state !== "done" || (propagation && !propagation.unused);
  return (
    <SourceRow text={why ?? (there.join(", ") || "All that is there is used")} action={label}>
      {job && isPresent && <JobNote job={job} doubtful={missing.length > 0} />}
      {propagation && missing.length > 0 && <Note mood="warn">{missing.map((name) => `${name}: no example, so no hull gets it.`).join(" ")}</Note>}
      {job && isPresent && <JobLines lines={lost} />}
      {propagation?.next && (
        <Button look="quiet" icon={ArrowRight} onClick={() => openAsset(propagation.next)} tip="It helps most if you label it">
          Label next: {shortName(propagation.next)}
        </Button>
      )}
    </SourceRow>
  );
}

/** What there is that is not used yet. */
function useSourceTexts(): string[] {
  const { files, names } = useLabelSources();
  const { given, assets } = labelProgress(useProject((state) => state.cards));
  const propagation = useProject((state) => state.project.propagation);
  const labels = propagation ? propagation.unused : given;
  return [
    files ? `labels files beside ${countText(files, "asset")}` : "",
    names ? `names of ${countText(names, "hull")}` : "",
    labels ? (propagation ? `${countText(labels, "label")} not used yet` : `${countText(labels, "label")} on ${countText(assets, "asset")}`) : "",
  ].filter(Boolean);
}

/** Labelling that is under way; counted: whether it can be counted. */
function Running({ job, counted, text }: { job: Job; counted: boolean; text: string }) {
  const action = (
    <Button icon={Square} onClick={() => cancelJob(job.id)} aria-label="Stop labelling">
      Stop
    </Button>
  );
  return (
    <SourceRow text={<span role="status">{text}</span>} action={action}>
      <progress className={css.progress} value={counted ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </SourceRow>
  );
}
