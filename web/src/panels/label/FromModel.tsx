// Labels from a vision-language model: what that would send and cost comes first, then the asking.
import { Eye, Square } from "lucide-react";
import { useState } from "react";
import { askModel, cancelJob, forecastAsking } from "../../store/jobs";
import { useProject } from "../../store/project";
import type { Job, Model } from "../../wire";
import { Button } from "../../ui/Button";
import { Choice } from "../../ui/Choice";
import { Note } from "../../ui/Section";
import { useJob } from "../review/useJob";
import { Way } from "./Way";
import css from "./ways.module.css";

const TITLE = "From a model";
const MODES = [
  { value: "cheap", label: "Cheap", name: "One question about a whole asset" },
  { value: "balanced", label: "Balanced", name: "Two questions about each dozen hulls" },
  { value: "exact", label: "Exact", name: "One question about each view of every five hulls" },
] as const;
const MOODS = { running: "plain", done: "good", failed: "bad", cancelled: "warn" } as const;
type Mode = Model["mode"];

/** What is chosen, and the forecast that was asked for: it is of its mode and its vocabulary only. */
interface Chosen {
  mode: Mode;
  limit: string;
  forecast: { job: string; mode: Mode; vocabulary: string } | null;
}

/** model: the one that the project's settings name. */
export function FromModel({ model }: { model: Model | null }) {
  const asking = useJob("ask");
  const counting = useJob("forecast");
  const limit = model?.max_cost?.toString() ?? "";
  const [chosen, setChosen] = useState<Chosen>({ mode: model?.mode ?? "balanced", limit, forecast: null });
  if (asking?.state === "running") return <Running job={asking} stop="Stop asking" />;
  if (counting?.state === "running") return <Running job={counting} stop="Stop counting" />;
  if (!model) return <Way icon={Eye} title={TITLE} text="Name one under [vlm] in meshforge.toml" action={null} />;
  return <Ready model={model} asked={asking} chosen={chosen} choose={(next) => setChosen({ ...chosen, ...next })} />;
}

interface ReadyProps {
  model: Model;
  asked: Job | null;
  chosen: Chosen;
  choose: (next: Partial<Chosen>) => void;
}

function Ready({ model, asked, chosen, choose }: ReadyProps) {
  const { mode, limit, forecast } = chosen;
  const vocabulary = useProject((state) => state.project.vocabulary.join("\n"));
  const told = useProject((state) => state.jobs.find((job) => job.id === forecast?.job) ?? null);
  const isFor = forecast?.mode === mode && forecast.vocabulary === vocabulary;
  const isTold = isFor && told?.state === "done";
  const most = limit.trim() === "" ? null : Number(limit);
  const isLimit = most === null || (Number.isFinite(most) && most >= 0);

  async function count() {
    const job = await forecastAsking(mode);
    if (job) choose({ forecast: { job, mode, vocabulary } });
  }
  async function ask() {
    if (await askModel(mode, most)) choose({ forecast: null });
  }
  const action = isTold ? (
    <Button look="primary" disabled={!isLimit} onClick={() => void ask()} aria-label={`Ask ${model.name}`}>
      Ask
    </Button>
  ) : (
    <Button
      disabled={model.why !== null}
      onClick={() => void count()}
      aria-label="What asking would cost"
      tip="Counts questions, pictures and tokens; nothing is sent"
    >
      Cost…
    </Button>
  );
  return (
    <Way icon={Eye} title={TITLE} text={model.why ?? `${model.name} at ${model.host}`} action={action}>
      {model.why === null && (
        <div className={css.model}>
          <Choice name="How much is asked" value={mode} options={MODES} onChange={(next) => choose({ mode: next })} />
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
      {isTold && <Note>{told.message}</Note>}
      {isFor && told?.state === "failed" && <Note mood="bad">{told.message}</Note>}
      {asked && !isTold && <Note mood={MOODS[asked.state]}>{asked.message}</Note>}
    </Way>
  );
}

function Running({ job, stop }: { job: Job; stop: string }) {
  const action = (
    <Button icon={Square} onClick={() => cancelJob(job.id)} aria-label={stop}>
      Stop
    </Button>
  );
  const text = <span role="status">{`${job.title}: ${job.done} of ${job.total}`}</span>;
  return (
    <Way icon={Eye} title={TITLE} text={text} action={action}>
      <progress className={css.progress} value={job.done} max={job.total || 1} aria-label={job.title} />
    </Way>
  );
}
