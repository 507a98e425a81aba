// The program, rule by rule or as a text to edit, and how it stands to what was learned.
import { Pencil } from "lucide-react";
import { learnNow } from "../../commands/learn";
import { useProject } from "../../store/project";
import { learnedDiffers } from "../../store/readings";
import { countText, errorParts, shortName } from "../../store/words";
import { visit } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Note, Section } from "../../ui/Section";
import css from "./learn.module.css";
import { editProgram, ProgramEditor, useProgramDraft } from "./ProgramEditor";
import { RuleList } from "./RuleList";

export function ProgramSection() {
  const draft = useProgramDraft((state) => state.draft);
  const there = useProject((state) => state.program.text.trim() !== "" || state.program.error !== null);
  const edit = (
    <Button look="quiet" icon={Pencil} onClick={editProgram}>
      {there ? "Edit as text" : "Write as text"}
    </Button>
  );
  return (
    <Section title="Program" aside={draft ? null : edit}>
      {draft ? (
        <ProgramEditor {...draft} />
      ) : (
        <>
          <ProgramNotes />
          <RuleList />
        </>
      )}
    </Section>
  );
}

/** What must be known about the program before reading it: damaged, by hand, out of date, failing somewhere. */
function ProgramNotes() {
  const program = useProject((state) => state.program);
  const problem = useProject((state) => state.project.problem);
  const learning = useProject((state) => state.learning);
  return (
    <div className={css.notes}>
      {program.error && <Note mood="bad">The program cannot be read: {program.error}</Note>}
      {problem && problem !== program.error && <Note mood="bad">{problem}</Note>}
      {program.by_hand && program.text !== "" && <HandWritten />}
      {program.outdated && !program.by_hand && !learning && <Note mood="warn">Out of date: the demonstrations changed, and no new program is learned yet.</Note>}
      <LostResults />
      <Failures />
    </div>
  );
}

/** Which accepted results no program keeps. */
function LostResults() {
  const overruled = useProject((state) => state.outcome?.overruled);
  const first = overruled?.[0];
  if (!first) return null;
  const some = overruled.length === 1 ? `the accepted result of ${shortName(first)}` : `${overruled.length} accepted results`;
  return <Note mood="warn">No program fits the demonstrations and keeps {some}. The program ignores them: review them again.</Note>;
}

function HandWritten() {
  const differs = useProject((state) => learnedDiffers(state.program, state.outcome));
  return (
    <Note>
      <div className={css.split}>
        <span>Written by hand: learning does not change it.</span>
        {differs && <Button onClick={() => void learnNow()}>Use the learned program</Button>}
      </div>
    </Note>
  );
}

/** Where the program does not run. */
function Failures() {
  const reach = useProject((state) => state.reach);
  const failing = Object.values(reach).filter((row) => row.error !== null);
  const first = failing[0];
  if (!first) return null;
  return (
    <Note mood="warn">
      <div className={css.split}>
        <span>
          Does not run on {countText(failing.length, "asset")}, first {shortName(first.asset)}: {errorParts(first.error ?? "", first.asset).message}.
        </span>
        <Button look="quiet" onClick={() => visit(first.asset, { kind: "source" })}>
          Open
        </Button>
      </div>
    </Note>
  );
}
