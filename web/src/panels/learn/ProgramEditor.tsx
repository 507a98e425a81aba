// The program as a text to edit, checked while one types; what is typed stays, also in another stage, until it is saved or
// cancelled.
import { Check } from "lucide-react";
import type { KeyboardEvent } from "react";
import { create } from "zustand";
import { writeProgram } from "../../commands/learn";
import { api } from "../../server/api";
import { ServerProblem } from "../../server/http";
import { useProject } from "../../store/project";
import { ProgramText } from "../../text/ProgramText";
import type { ProgramCheck, ProgramView } from "../../wire";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { useAnswer } from "../../ui/useAnswer";
import css from "./learn.module.css";

/** The text in hand, and the program that it was begun from; null while none is edited. */
export const useProgramDraft = create<{ draft: { begun: ProgramView; text: string } | null }>()(() => ({ draft: null }));

export function editProgram(): void {
  const begun = useProject.getState().program;
  useProgramDraft.setState({ draft: { begun, text: begun.text } });
}

const close = (): void => useProgramDraft.setState({ draft: null });

export function ProgramEditor({ begun, text }: { begun: ProgramView; text: string }) {
  const setText = (now: string) => useProgramDraft.setState({ draft: { begun, text: now } });
  const elsewhere = useProject((state) => state.program.version !== begun.version);
  const check = useAnswer(text, (stop) => checkText(text, stop), 200);
  const mark = check?.mark ?? null;
  const changed = text !== begun.text;
  const save = async () => {
    if (changed && !mark && (await writeProgram(text, begun.version))) close();
  };
  return (
    <div className={css.editor} onKeyDown={(event) => keys(event, () => void save(), () => !changed && close())}>
      <ProgramText text={text} onChange={setText} marks={mark ? [mark] : []} />
      {mark && (
        <Note mood="bad">
          Line {mark.line}, column {mark.column}: {mark.message}
        </Note>
      )}
      {elsewhere && <Note mood="warn">Another window changed the program: copy your text, cancel, and edit again.</Note>}
      <div className={css.row}>
        <Button
          look="primary"
          icon={Check}
          disabled={!changed || mark !== null || elsewhere}
          tip="Make it the program"
          keys="Ctrl+Enter"
          onClick={() => void save()}
        >
          Save
        </Button>
        <Button onClick={close}>Cancel</Button>
      </div>
      {!mark && check && <Sentences check={check} />}
    </div>
  );
}

function Sentences({ check }: { check: ProgramCheck }) {
  return (
    <>
      {check.orient_sentence && <p className={css.dim}>{check.orient_sentence}</p>}
      <ol className={css.sentences} aria-label="The program in words">
        {check.rules.map((rule) => (
          <li key={rule.rule}>{rule.sentence}</li>
        ))}
      </ol>
    </>
  );
}

async function checkText(text: string, stop: AbortSignal): Promise<ProgramCheck> {
  try {
    return await api.checkProgram(text, stop);
  } catch (error) {
    if (!(error instanceof ServerProblem)) throw error;
    return { mark: { line: 1, column: 1, message: error.problem.message }, rules: [], orient_sentence: "" };
  }
}

function keys(event: KeyboardEvent, save: () => void, leave: () => void): void {
  const isSave = event.key === "Enter" && (event.ctrlKey || event.metaKey);
  if (!isSave && (event.key !== "Escape" || event.defaultPrevented)) return;
  event.preventDefault();
  event.stopPropagation();
  (isSave ? save : leave)();
}
