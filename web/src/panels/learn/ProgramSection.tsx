// The program, rule by rule or as a text to edit, and how it stands to what was learned.
import { Pencil } from "lucide-react";
import { useState } from "react";
import { useProject } from "../../store/project";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import { ProgramEditor } from "./ProgramEditor";
import { ProgramNotes } from "./ProgramNotes";
import { RuleList } from "./RuleList";

export function ProgramSection() {
  const [editing, setEditing] = useState(false);
  const there = useProject((state) => state.program.text.trim() !== "" || state.program.error !== null);
  const edit = (
    <Button look="quiet" icon={Pencil} onClick={() => setEditing(true)}>
      {there ? "Edit as text" : "Write it"}
    </Button>
  );
  return (
    <Section title="Program" aside={editing ? null : edit}>
      {editing ? (
        <ProgramEditor onClose={() => setEditing(false)} />
      ) : (
        <>
          <ProgramNotes />
          <RuleList />
        </>
      )}
    </Section>
  );
}
