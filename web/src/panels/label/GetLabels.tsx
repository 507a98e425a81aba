// The ways to get labels other than by hand, each with what it would give: from labelled assets, from files, from
// names, from a vision-language model.
import { ArrowRight, Eye, FileText, type LucideIcon, Square, Type, Waypoints } from "lucide-react";
import { type ReactNode, useEffect, useState } from "react";
import { api } from "../../server/api";
import { perform } from "../../store/edits";
import { askModel, cancelJob, forecastModel, propagateLabels, useJob, whyNotPropagate } from "../../store/jobs";
import { countReadable, useProject } from "../../store/project";
import { reportError } from "../../store/toasts";
import { givenLabels } from "../../store/unsureHulls";
import { countText } from "../../store/words";
import { openAsset, useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Choice } from "../../ui/fields";
import { Note, Section } from "../../ui/Section";
import type { Job, LabelSources, Model } from "../../wire";
import { JobNote } from "../review/JobProgress";
import css from "./getLabels.module.css";

export function GetLabels() {
  const { files, names, model } = useSources();
  const beside = files ? `beside ${countText(files, "asset")}` : "";
  const named = names ? `of ${countText(names, "hull")} without a label` : "";
  return (
    <Section title="Get labels">
      <ul className={css.ways}>
        <FromAssets />
        <Ready icon={FileText} title="From files" kind="label-files" text={beside} tip="Use the labels files beside the assets" />
        <Ready icon={Type} title="From names" kind="label-names" text={named} tip="Use labels found in the names of hulls and bodies" />
        <FromModel key={model?.name} model={model} />
      </ul>
    </Section>
  );
}

/** How much there is, asked anew when labels or assets change, and as more assets are read. */
function useSources(): LabelSources {
  const [sources, setSources] = useState<LabelSources>({ files: 0, names: 0, model: null });
  const vocabulary = useProject((state) => state.project.vocabulary);
  const assets = useProject((state) => state.order.length);
  const read = useProject((state) => countReadable(state.cards));
  useEffect(() => {
    let is = true;
    const timer = setTimeout(() => {
      api.labelSources().then((found) => is && setSources(found), reportError);
    }, 250);
    return () => {
      is = false;
      clearTimeout(timer);
    };
  }, [vocabulary, assets, read]);
  return sources;
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

interface ReadyProps extends Pick<SourceRowProps, "icon" | "title"> {
  kind: "label-files" | "label-names";
  /** What there is to take, empty for nothing. */
  text: string;
  tip: string;
}

/** Labels that are there and need only be taken. */
function Ready({ icon, title, kind, text, tip }: ReadyProps) {
  if (!text) return null;
  const take = (
    <Button onClick={() => void perform({ kind })} aria-label={`${title} ${text}: take`} tip={tip}>
      Take
    </Button>
  );
  return <SourceRow icon={icon} title={title} text={text} action={take} />;
}

const PROPAGATE_TITLE = "From labelled assets";

/** Labels propagated from the assets that a person or a file has labelled to all others. */
function FromAssets() {
  const job = useJob("propagate");
  if (job?.state !== "running") return <PropagateReady job={job} />;
  const reading = job.done < job.total; // comparing all hulls cannot be counted
  const text = reading ? `Reading assets: ${job.done} of ${job.total}` : "Comparing all hulls…";
  return <Running icon={Waypoints} title={PROPAGATE_TITLE} job={job} counted={reading} stop="Stop propagating labels" text={text} />;
}

function PropagateReady({ job }: { job: Job | null }) {
  const why = useProject(whyNotPropagate);
  const given = useGiven();
  const carried = useProject((state) => state.project.carried);
  const unused = carried?.unused ?? 0;
  const carry = (
    <Button
      look={why === null && (!carried || unused > 0) ? "primary" : "plain"}
      disabled={why !== null}
      onClick={() => void propagateLabels()}
      tip="Label all other hulls like the labelled hulls that they resemble most"
      keys="P"
    >
      <span>
        Propagate<span className="visually-hidden"> labels</span>
        {carried && " again"}
      </span>
    </Button>
  );
  const text = why ?? (carried ? sinceThen(unused) : given);
  return (
    <SourceRow icon={Waypoints} title={PROPAGATE_TITLE} text={text} action={carry}>
      {(job?.state === "failed" || job?.state === "cancelled") && <JobNote job={job} />}
      {carried?.next && <Best asset={carried.next} />}
    </SourceRow>
  );
}

const sinceThen = (unused: number): string =>
  unused ? `${countText(unused, "label")} not propagated yet` : "All your labels are propagated";

function useGiven(): string {
  const { given, assets } = givenLabels(useProject((state) => state.cards));
  return `${countText(given, "label")} on ${countText(assets, "asset")}`;
}

/** The asset that helps most if you label it. */
function Best({ asset }: { asset: string }) {
  const isOpen = useWorkspace((workspace) => workspace.asset === asset);
  return (
    <div className={css.best}>
      <span title={`${asset} helps most if you label it`}>
        Label next: <b>{asset}</b>
      </span>
      {!isOpen && (
        <IconButton icon={ArrowRight} name={`Open ${asset} and label it`} onClick={() => openAsset(asset)} />
      )}
    </div>
  );
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
