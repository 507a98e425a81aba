// The form of a goal: which one, on what, with which options; tried on all assets before it is kept.
import { Check, Play } from "lucide-react";
import { useCallback, useEffect, useMemo } from "react";
import { api } from "../../server/api";
import { perform } from "../../store/edits";
import { changeGoal, dropGoal, freeName, type GoalDraft } from "../../store/goals";
import { tryGoal, useJob } from "../../store/jobs";
import { useProject } from "../../store/project";
import { countText } from "../../store/words";
import { setHighlight, useWorkspace, visit } from "../../store/workspace";
import { useFetched } from "../../pictures/useFetched";
import { Button } from "../../ui/Button";
import { useAnswer } from "../../ui/useAnswer";
import { whilePointed } from "../../ui/whilePointed";
import type { Argument, ExtractorSuggestion, GoalCall, Job, Operator } from "../../wire";
import { Field } from "../demonstrate/ArgumentField";
import { EnlargeablePicture } from "./CheckPictures";
import css from "./goals.module.css";
import { JobLines, JobNote, JobProgress } from "../../ui/JobProgress";
import review from "./review.module.css";

export function GoalForm({ draft }: { draft: GoalDraft }) {
  const { call, name, was } = draft;
  const forms = useProject((state) => state.language.goals);
  const goals = useProject((state) => state.project.goals);
  const form = forms.find((one) => one.name === call.name);
  const check = useAnswer(call, (stop) => api.checkGoal(call, stop), 120);
  const suggested = useSuggestions();
  const proposal = freeName(check?.name || call.name, goals, was);
  const job = useJob("goal");
  const mine = job && (job.state === "running" || job.title === `Trying ${check?.text}`) ? job : null;
  const isBare = form?.arguments.some((one) => one.required && !call.arguments[one.name]); // nothing to complain of yet
  const ready = !isBare && !check?.error;
  useEffect(showSource, []);
  /** Does something with the goal as it is in the form now, which may not be checked yet. */
  const doWith = async (act: (text: string) => Promise<boolean>): Promise<boolean> => {
    const { text, error } = await api.checkGoal(call);
    return error === null && act(text);
  };
  const keep = async () => {
    if (await doWith((text) => perform({ kind: "goal", name: (name ?? proposal).trim(), text, was }))) dropGoal();
  };
  return (
    <form
      ref={toView}
      className={css.form}
      aria-label={was === null ? "A new goal" : `Change ${was}`}
      onSubmit={(event) => {
        event.preventDefault();
        void keep();
      }}
    >
      <div className={css.kinds} role="group" aria-label="Goal">
        {forms.map((one) => (
          <button key={one.name} type="button" aria-pressed={one.name === call.name} title={one.summary} onClick={() => changeGoal({ call: callOf(one, call) })}>
            {one.name}
          </button>
        ))}
      </div>
      {form && (
        <p>
          <span role="status">{check?.sentence || form.summary}</span> <code className={[review.code, review.dim].join(" ")}>{form.usage}</code>
        </p>
      )}
      {form?.arguments.map((argument) => (
        <GoalField key={argument.name} argument={argument} call={call} suggested={suggested} />
      ))}
      {check?.error && !isBare && (
        <pre className={css.error} role="alert">
          {check.error}
        </pre>
      )}
      <Field name="Name" inline>
        <input className={review.field} aria-label="Name of the goal" value={name ?? proposal} spellCheck={false} onChange={(event) => changeGoal({ name: event.target.value })} />
      </Field>
      {mine && <Outcome job={mine} />}
      <div className={[review.row, css.ending].join(" ")}>
        <Button icon={Play} disabled={!ready || job?.state === "running"} tip="Tries it on all assets, before and after the program" onClick={() => void doWith(tryGoal)}>
          Try it
        </Button>
        <Button type="submit" look="primary" icon={Check} disabled={!ready || !(name ?? proposal).trim()}>
          Keep
        </Button>
        <Button look="quiet" onClick={dropGoal}>
          Cancel
        </Button>
      </div>
    </form>
  );
}

function toView(form: HTMLElement | null): void {
  form?.scrollIntoView({ block: "start" });
}

/** Goals select hulls of the asset as it comes. */
function showSource(): void {
  const { asset, showing, selection } = useWorkspace.getState();
  if (asset !== null && showing.kind !== "source") visit(asset, { kind: "source" }, showing.kind === "steps" ? selection : []);
}

/** Another goal on the same hulls: these are the first argument of most. */
function callOf({ name, arguments: [first] }: Operator, { arguments: given }: GoalCall): GoalCall {
  const [about] = Object.values(given);
  return { name, arguments: first && about ? { [first.name]: about } : {} };
}

interface GoalFieldProps {
  argument: Argument;
  call: GoalCall;
  suggested: Suggested | null;
}

function GoalField({ argument: { name, kind, title, wants, choices, words, omitted, required }, call, suggested }: GoalFieldProps) {
  const value = call.arguments[name] ?? "";
  const set = (text: string) => changeGoal({ call: { ...call, arguments: { ...call.arguments, [name]: text } } });
  if (kind === "words") {
    return (
      <Field name={title} inline>
        <select className={review.field} aria-label={title} value={value} onChange={(event) => set(event.target.value)}>
          <option value="">{words[omitted] ?? (omitted || "none")}</option>
          {choices.map((word) => (
            <option key={word} value={word}>
              {words[word] ?? word}
            </option>
          ))}
        </select>
      </Field>
    );
  }
  return (
    <Field name={title} inline={kind === "text"}>
      <div className={css.field}>
        <input className={[review.field, review.code].join(" ")} aria-label={title} title={wants} placeholder={omitted || (required ? "Is(label)" : "")} value={value} spellCheck={false} onChange={(event) => set(event.target.value)} />
        {kind === "text" && <small className={review.dim}>{wants}</small>}
      </div>
      {kind === "extractor" && (required || suggested) && <Suggestions value={value} onPick={set} always={required} suggested={suggested} />}
    </Field>
  );
}

type Suggested = Readonly<{ asset: string; rows: readonly ExtractorSuggestion[] }>;

/** Extractors for the hulls that are selected in the view; null where there are none. */
function useSuggestions(): Suggested | null {
  const asset = useWorkspace((state) => (state.showing.kind === "source" ? state.asset : null));
  const selection = useWorkspace((state) => state.selection);
  const fetch = useCallback(() => (asset !== null && selection.size ? api.extractorsFor(asset, [...selection]) : Promise.resolve([])), [asset, selection]);
  const found = useFetched(fetch);
  return asset !== null && selection.size > 0 && Array.isArray(found) ? { asset, rows: found } : null;
}

interface SuggestionsProps {
  value: string;
  onPick: (text: string) => void;
  /** Whether they show while the field does not have the focus, too. */
  always: boolean;
  suggested: Suggested | null;
}

function Suggestions({ value, onPick, always, suggested }: SuggestionsProps) {
  if (!suggested?.rows.length) return value ? null : <small className={review.dim}>{suggested ? "No extractor was found for these hulls: type one." : "Select hulls in the view, or type which."}</small>;
  const { asset, rows } = suggested;
  return (
    <div className={css.suggestions} data-always={always} role="group" aria-label="For the selected hulls" onPointerDown={(event) => event.preventDefault()}>
      {rows.map(({ text, sentence, places }) => (
        <button key={text} type="button" title={sentence} aria-pressed={text === value} onClick={() => onPick(text)} {...whilePointed(() => setHighlight({ what: text, assets: { [asset]: places } }), () => setHighlight(null))}>
          <code className={review.code}>{text}</code>
          <span>{countText(places.length, "hull")} here</span>
        </button>
      ))}
    </div>
  );
}

/** How trying it goes, and what came of it: the first failure with its picture. */
function Outcome({ job }: { job: Job }) {
  const failed = useMemo(() => job.lines.filter(({ status }) => status === "failed"), [job.lines]);
  const shown = failed.find(({ picture }) => picture !== null);
  if (job.state === "running") return <JobProgress job={job} unit="asset" />;
  return (
    <div className={css.outcome}>
      <JobNote job={job} />
      {shown?.picture && <EnlargeablePicture source={api.goalPicture(shown.asset, shown.picture)} text={`${shown.asset}: ${shown.text}`} />}
      <JobLines lines={failed} />
    </div>
  );
}
