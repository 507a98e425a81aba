// The action in hand as a form: which action, its arguments, what it would do, and the button that keeps it.
import { Check } from "lucide-react";
import type { KeyboardEvent } from "react";
import { runInTurn } from "../../commands/queue";
import { ACTION_ICONS } from "../../steps/actionIcon";
import { callOf, formOf, missingArgument } from "../../store/actions";
import { acceptDraft, changeArgument, changeDraft, dropDraft, startDraft, useDraftStatus } from "../../store/draft";
import { previewText, usePreview } from "../../store/preview";
import { useProject } from "../../store/project";
import { changeActionOn, differsOn } from "../../store/steps";
import { listText, shortName } from "../../store/words";
import { type Draft, useWorkspace } from "../../store/workspace";
import { Button, Tip } from "../../ui/Button";
import { Check as CheckBox } from "../../ui/fields";
import { Note, ProblemNote } from "../../ui/Section";
import type { ActionForm } from "../../wire";
import { ArgumentField, Field } from "./ArgumentField";
import css from "./demonstrate.module.css";

export function DraftForm() {
  const draft = useWorkspace((workspace) => workspace.draft);
  const forms = useProject((state) => state.language.actions);
  const form = draft && formOf(draft.name, forms);
  const selected = useWorkspace((workspace) => workspace.selection.size);
  const onKeyDown = (event: KeyboardEvent) => {
    if (!draft || !isAcceptKey(event)) return;
    event.preventDefault();
    accept();
  };
  return (
    <div className={css.draft} onKeyDown={onKeyDown}>
      <ActionChoice forms={forms} action={draft?.name ?? null} />
      {draft && form ? <Form draft={draft} form={form} /> : <p className={css.hint}>{selected ? "Choose an action." : "Select hulls in the view, then choose an action."}</p>}
    </div>
  );
}

const accept = (): void => runInTurn(acceptDraft);

/** Enter accepts, also on a switch that a click left the focus on; Space switches. */
function isAcceptKey({ key, target, ctrlKey, metaKey, altKey }: KeyboardEvent): boolean {
  if (key !== "Enter" || ctrlKey || metaKey || altKey || !(target instanceof Element)) return false;
  return target.matches("[aria-pressed=true], [role=radio], [role=slider], input, select");
}

function Form({ draft, form }: { draft: Draft; form: ActionForm }) {
  const selected = useWorkspace((workspace) => workspace.selection.size);
  const sending = useDraftStatus((state) => state.sending);
  const isReview = useWorkspace((workspace) => workspace.stage === "review");
  const lacking = missingArgument(draft, form);
  return (
    <form
      className={css.form}
      aria-label={`${draft.name}: how`}
      onSubmit={(event) => {
        event.preventDefault();
        accept();
      }}
    >
      {form.arguments.map((argument) => (
        <ArgumentField
          key={argument.name}
          argument={argument}
          value={draft.arguments[argument.name]}
          given={draft.arguments}
          form={form}
          onChange={(value) => changeArgument(form.name, argument.name, value)}
        />
      ))}
      <CheckBox checked={draft.each} keys="E" onChange={(each) => changeDraft({ each })}>
        Each connected part separately
      </CheckBox>
      {form.makes && (
        <Field name="Label of new hulls" inline>
          <LabelSelect value={draft.label} onChange={(label) => changeDraft({ label })} />
        </Field>
      )}
      {!isReview && <RulePlace draft={draft} />}
      <div className={css.ending}>
        <PreviewNote lacking={lacking ? `Missing: ${lacking.wants}.` : null} />
        <div className={css.buttons}>
          <Button
            type="submit"
            look="primary"
            icon={Check}
            disabled={!selected || lacking !== undefined || sending}
            keys="Enter"
            tip={selected ? "Keep it" : "Select hulls first"}
          >
            {isReview ? "Keep this edit" : draft.editing === null ? "Add step" : `Keep as step ${draft.editing + 1}`}
          </Button>
          <Button onClick={() => void dropDraft()} keys="Esc" tip="Cancel the action">
            Cancel
          </Button>
        </div>
      </div>
    </form>
  );
}

/** The actions of the language, each with its key. */
function ActionChoice({ forms, action }: { forms: readonly ActionForm[]; action: string | null }) {
  return (
    <div className={css.actions} role="group" aria-label="Action">
      {forms.map(({ name, summary, key, icon }) => {
        const Icon = ACTION_ICONS[icon];
        return (
          <Tip key={name} text={summary} keys={key || undefined}>
            <button type="button" className={css.action} aria-pressed={action === name} onClick={() => runInTurn(() => startDraft(name))}>
              <Icon size={17} aria-hidden />
              {name}
              <kbd aria-hidden>{key.replace("Shift+", "⇧")}</kbd>
            </button>
          </Tip>
        );
      })}
    </div>
  );
}

/** What the action in hand would do, in words, or why it cannot be done. */
function PreviewNote({ lacking }: { lacking: string | null }) {
  const selected = useWorkspace((workspace) => workspace.selection.size);
  const header = usePreview((state) => state.preview?.header ?? null);
  const problem = useDraftStatus((state) => state.problem);
  if (lacking) return <Note>{lacking}</Note>;
  if (!selected) return <Note>Nothing is selected: click the hulls in the view.</Note>;
  if (problem) return <ProblemNote {...problem} />;
  if (!header) return <Note>{selected === 1 ? "1 hull" : `${selected} hulls`} selected</Note>;
  const wrong = header.findings.filter((finding) => finding.severity === "error");
  return (
    <Note mood={wrong.length ? "warn" : "plain"}>
      <strong>{previewText(selected, header)}</strong>
      {header.note && <p>{header.note}</p>}
      {wrong.map((finding, k) => (
        <p key={k}>
          {finding.hull && `${finding.hull}: `}
          {finding.text}
        </p>
      ))}
    </Note>
  );
}

/** Which rule of the family the action in hand shows: one that other assets show, or a new one. */
function RulePlace({ draft }: { draft: Draft }) {
  const rules = useProject((state) => state.project.rules);
  if (!rules.length) return null;
  return (
    <>
      <Field name="Rule" inline>
        <select
          className={css.input}
          aria-label="Rule that it demonstrates"
          value={draft.editing ?? "new"}
          onChange={(event) =>
            changeDraft({ editing: event.target.value === "new" ? null : Number(event.target.value) })
          }
        >
          {rules.map((rule, place) => (
            <option key={rule.rule} value={place}>
              {rule.rule}: {rule.action.text}
            </option>
          ))}
          <option value="new">a new one</option>
        </select>
      </Field>
      {draft.editing !== null && <Differs place={draft.editing} draft={draft} />}
    </>
  );
}

/** A rule does the same everywhere: warns where it would not. */
function Differs({ place, draft }: { place: number; draft: Draft }) {
  const asset = useWorkspace((workspace) => workspace.asset);
  const rules = useProject((state) => state.project.rules);
  const [rule, others] = [rules[place], differsOn(draft, rules, asset)];
  if (!rule || !others.length) return null;
  return (
    <Note mood="warn">
      A rule does the same on every asset. On {listText(others.map(shortName), 2)} this rule is {rule.action.text}.
      <div className={css.buttons}>
        <Button onClick={() => changeDraft({ editing: null })}>Make this a new rule</Button>
        <Button onClick={() => void changeActionOn(others, place, callOf(draft))}>Change it there too</Button>
      </div>
    </Note>
  );
}

/** The label of what an action makes: that of the hulls it is made of, or another one. */
function LabelSelect({ value, onChange }: { value: string | null; onChange: (value: string | null) => void }) {
  const vocabulary = useProject((state) => state.project.vocabulary);
  return (
    <select
      className={css.input}
      aria-label="Label of new hulls"
      value={value ?? ""}
      onChange={(event) => onChange(event.target.value || null)}
    >
      <option value="">same as its source</option>
      {vocabulary.map(({ name }) => (
        <option key={name} value={name}>
          {name}
        </option>
      ))}
    </select>
  );
}
