// The action in hand as a form: which action, its arguments, what it would do, and the button that keeps it.
import { Check } from "lucide-react";
import type { KeyboardEvent } from "react";
import { inTurn } from "../../commands/turns";
import { type Draft, useDesk } from "../../store/desk";
import { acceptDraft, changeArgument, changeDraft, dropDraft, useDrafting } from "../../store/drafting";
import { missingArgument } from "../../store/drafts";
import { formOf, useLanguage } from "../../store/language";
import { complainedOf } from "../../store/toasts";
import type { ActionForm } from "../../wire";
import { Button } from "../../ui/Button";
import { Check as CheckBox } from "../../ui/Check";
import { ActionChoice } from "./ActionChoice";
import { ArgumentField } from "./ArgumentField";
import { Labelled } from "./Labelled";
import { MadeLabel } from "./MadeLabel";
import { PreviewNote } from "./PreviewNote";
import { RulePlace } from "./RulePlace";
import css from "./demonstrate.module.css";

export function DraftForm() {
  const draft = useDesk((desk) => desk.draft);
  const forms = useLanguage((state) => state.language?.actions);
  if (!forms) return null;
  const form = draft && formOf(draft.action, forms);
  const onKeyDown = (event: KeyboardEvent) => {
    if (!draft || !isAccepting(event)) return;
    event.preventDefault();
    accept();
  };
  return (
    <div className={css.draft} onKeyDown={onKeyDown}>
      <ActionChoice forms={forms} action={draft?.action ?? null} />
      {draft && form ? <Form draft={draft} form={form} /> : <Hint />}
    </div>
  );
}

const accept = (): void => inTurn(acceptDraft);

/** Enter accepts, also on a switch that a click left the focus on; Space switches. */
function isAccepting({ key, target, ctrlKey, metaKey, altKey }: KeyboardEvent): boolean {
  if (key !== "Enter" || ctrlKey || metaKey || altKey || !(target instanceof Element)) return false;
  return target.matches("[aria-pressed=true], [role=radio], [role=slider], input, select");
}

function Hint() {
  const selected = useDesk((desk) => desk.selection.size);
  return (
    <p className={css.hint}>{selected ? "Choose what happens to them." : "Select hulls in the view, then choose."}</p>
  );
}

function Form({ draft, form }: { draft: Draft; form: ActionForm }) {
  const selected = useDesk((desk) => desk.selection.size);
  const sending = useDrafting((state) => state.sending);
  const isReview = useDesk((desk) => desk.stage === "review");
  const lacking = missingArgument(draft, form);
  return (
    <form
      className={css.form}
      aria-label={`${draft.action}: how`}
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
          onChange={(value) => changeArgument(form.name, argument.name, value)}
        />
      ))}
      <CheckBox checked={draft.each} keys="E" onChange={(each) => changeDraft({ each })}>
        Each connected part separately
      </CheckBox>
      {form.makes && (
        <Labelled name="Label of what is made" inline>
          <MadeLabel value={draft.label} onChange={(label) => changeDraft({ label })} />
        </Labelled>
      )}
      {!isReview && <RulePlace draft={draft} form={form} />}
      <div className={css.ending}>
        <PreviewNote lacking={lacking ? `Still needed: ${lacking.wants}.` : null} />
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
          <Button onClick={() => void dropDraft().catch(complainedOf)} keys="Esc" tip="Put the action down">
            Cancel
          </Button>
        </div>
      </div>
    </form>
  );
}
