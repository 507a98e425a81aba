// The ways to get labels other than by hand, each with what it would use: all that is there, and a vision-language model.
import { ArrowRight, Eye, type LucideIcon, Square, Waypoints } from "lucide-react";
import { type ReactNode, useState } from "react";
import { askModel, cancelJob, forecastModel, labelAll, useJob, whyNotLabel } from "../../store/jobs";
import { useFreshSources, useLabelSources } from "../../store/labelSources";
import { labelProgress } from "../../store/labelWalk";
import { useProject } from "../../store/project";
import { capitalize, countText, shortName } from "../../store/words";
import { openAsset } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Choice } from "../../ui/fields";
import { Note, Section } from "../../ui/Section";
import type { Job, Model } from "../../wire";
import { JobLines, JobNote } from "../review/JobProgress";
import css from "./getLabels.module.css";

export function GetLabels() {
  const { model } = useFreshSources();
  return (
    <Section title="Get labels">
      <ul className={css.ways}>
        <FromAll />
        <FromModel key={model?.name} model={model} />
      </ul>
    </Section>
  );
}

interface SourceRowProps {
  icon: LucideIcon;
  title: string;
  /** What it would give, or why it gives nothing. */
  text: ReactNode;
  action: ReactNode;
  /** What there is more to tell, below. */
  children?: ReactNode;
}

/** One way to get labels: where they come from, what it would give, and the button that does it. */
function SourceRow({ icon: Icon, title, text, action, children }: SourceRowProps) {
  return (
    <li className={css.way}>
      <Icon size={16} aria-hidden className={css.sign} />
      <div className={css.words}>
        <span className={css.title}>{title}</span>
        <span className={css.text}>{text}</span>
      </div>
      {action}
      {children && <div className={css.more}>{children}</div>}
    </li>
  );
}

const ALL_TITLE = "From all that is there";

/** Labels from files, names, and the labels that there are, weighed together. */
function FromAll() {
  const job = useJob("label");
  if (job?.state !== "running") return <LabelReady job={job} />;
  const counted = job.done < job.total; // comparing all hulls cannot be counted
  const text = counted ? `${capitalize(job.doing || "reading")}: ${job.done} of ${job.total}` : "Comparing all hulls…";
  return <Running icon={Waypoints} title={ALL_TITLE} job={job} counted={counted} stop="Stop labelling" text={text} />;
}

function LabelReady({ job }: { job: Job | null }) {
  const why = useProject(whyNotLabel);
  const propagation = useProject((state) => state.project.propagation);
  const there = useSourceTexts();
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
    <SourceRow icon={Waypoints} title={ALL_TITLE} text={why ?? (there.join(", ") || "All that is there is used")} action={label}>
      {job && isPresent && <JobNote job={job} />}
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

/** A source that is being asked, with what counts so far; counted: whether that can be counted. */
function Running({ job, counted = true, stop, text, ...row }: Pick<SourceRowProps, "icon" | "title"> & { job: Job; counted?: boolean; stop: string; text: string }) {
  const action = (
    <Button icon={Square} onClick={() => cancelJob(job.id)} aria-label={stop}>
      Stop
    </Button>
  );
  return (
    <SourceRow {...row} text={<span role="status">{text}</span>} action={action}>
      <progress className={css.progress} value={counted ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </SourceRow>
  );
}

const MODEL_TITLE = "From a model";
const SCOPES = [
  { value: "exemplars", label: "Exemplars", name: "A few questions about hulls that all others are like" },
  { value: "every", label: "Every hull", name: "One question about each asset" },
] as const;
type Scope = (typeof SCOPES)[number]["value"];

/** What is chosen, and the forecast that was asked for: it is of its scope and its vocabulary only. */
interface Chosen {
  scope: Scope;
  limit: string;
  forecast: { job: string; scope: Scope; vocabulary: string } | null;
}

/** model: the one that the project's settings name. */
function FromModel({ model }: { model: Model | null }) {
  const asking = useJob("ask");
  const counting = useJob("forecast");
  const limit = model?.max_cost?.toString() ?? "";
  const [chosen, setChosen] = useState<Chosen>({ scope: model?.every_hull ? "every" : "exemplars", limit, forecast: null });
  const job = [asking, counting].find((one) => one?.state === "running");
  if (job) return <Running icon={Eye} title={MODEL_TITLE} job={job} stop={job.kind === "ask" ? "Stop asking" : "Stop counting"} text={`${job.title}: ${job.done} of ${job.total}`} />;
  if (!model) return <SourceRow icon={Eye} title={MODEL_TITLE} text="Set a model under [vlm] in meshforge.toml" action={null} />;
  return <ModelReady model={model} asked={asking} chosen={chosen} choose={(next) => setChosen({ ...chosen, ...next })} />;
}

interface ModelReadyProps {
  model: Model;
  asked: Job | null;
  chosen: Chosen;
  choose: (next: Partial<Chosen>) => void;
}

function ModelReady({ model, asked, chosen, choose }: ModelReadyProps) {
  const { scope, limit, forecast } = chosen;
  const vocabulary = useProject((state) => state.project.vocabulary.join("\n"));
  const forecastJob = useProject((state) => state.jobs.find((job) => job.id === forecast?.job) ?? null);
  const isFor = forecast?.scope === scope && forecast.vocabulary === vocabulary;
  const isKnown = isFor && forecastJob?.state === "done";
  const most = limit.trim() === "" ? null : Number(limit);
  const isLimit = most === null || (Number.isFinite(most) && most >= 0);

  async function count() {
    const job = await forecastModel(scope === "every");
    if (job) choose({ forecast: { job, scope, vocabulary } });
  }
  async function ask() {
    if (await askModel(scope === "every", most)) choose({ forecast: null });
  }
  const action = isKnown ? (
    <Button look="primary" disabled={!isLimit} onClick={() => void ask()} aria-label={`Ask ${model.name}`}>
      Ask
    </Button>
  ) : (
    <Button
      disabled={model.why !== null}
      onClick={() => void count()}
      aria-label="Cost… of asking"
      tip="Counts questions, pictures and tokens; nothing is sent"
    >
      Cost…
    </Button>
  );
  return (
    <SourceRow icon={Eye} title={MODEL_TITLE} text={model.why ?? `${model.name} at ${model.host}`} action={action}>
      {model.why === null && (
        <div className={css.model}>
          <Choice name="How much is asked" value={scope} options={SCOPES} onChange={(next) => choose({ scope: next })} />
          <label className={css.limit}>
            at most $
            <input
              value={limit}
              inputMode="decimal"
              aria-label="At most, in dollars"
              aria-invalid={!isLimit}
              onChange={(event) => choose({ limit: event.target.value })}
            />
          </label>
        </div>
      )}
      {isKnown && <Note>{forecastJob.message}</Note>}
      {isFor && forecastJob?.state === "failed" && <JobNote job={forecastJob} />}
      {asked && !isKnown && <JobNote job={asked} />}
    </SourceRow>
  );
}
