// The way to get labels other than by hand, with what it would use.
import { ArrowRight, Waypoints } from "lucide-react";
import { useMemo } from "react";
import { labelAll, useJob, whyNotLabel } from "../../store/jobs";
import { labelsWithoutHull } from "../../store/labels";
import { useFreshSources, useLabelSources } from "../../store/labelSources";
import { labelProgress } from "../../store/labelWalk";
import { useProject } from "../../store/project";
import { countText, shortName } from "../../store/words";
import { openAsset } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Note, Section } from "../../ui/Section";
import type { Job } from "../../wire";
import { JobLines, JobNote, JobProgress } from "../../ui/JobProgress";
import css from "./getLabels.module.css";

export function GetLabels() {
  const job = useJob("label");
  useFreshSources();
  return <Section title="Get labels">{job?.state === "running" ? <JobProgress job={job} /> : <LabelReady job={job} />}</Section>;
}

/** Labels from files, names, and the labels that there are, weighed together: what there is, and the button that does it. */
function LabelReady({ job }: { job: Job | null }) {
  const why = useProject(whyNotLabel);
  const propagation = useProject((state) => state.project.propagation);
  const there = useSourceTexts();
  const [cards, vocabulary] = [useProject((state) => state.cards), useProject((state) => state.project.vocabulary)];
  const missing = useMemo(() => labelsWithoutHull(cards, vocabulary), [cards, vocabulary]);
  const lost = job?.lines.filter(({ status }) => status === "failed") ?? [];
  const isPresent = job?.state !== "done" || (propagation && !propagation.unused);
  return (
    <div className={css.way}>
      <Waypoints size={16} aria-hidden className={css.sign} />
      <div className={css.words}>
        <span>From all that is there</span>
        <span className={css.text}>{why ?? (there.join(", ") || "All that is there is used")}</span>
      </div>
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
      <div className={css.more}>
        {job && isPresent && <JobNote job={job} doubtful={missing.length > 0} />}
        {propagation && missing.length > 0 && <Note mood="warn">{missing.map((name) => `${name}: no example, so no hull gets it.`).join(" ")}</Note>}
        {job && isPresent && <JobLines lines={lost} />}
        {propagation?.next && (
          <Button look="quiet" icon={ArrowRight} onClick={() => openAsset(propagation.next)} tip="It helps most if you label it">
            Label next: {shortName(propagation.next)}
          </Button>
        )}
      </div>
    </div>
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
