// Which outputs are copied into a folder, and where they lie then.
import { Copy, FolderOutput } from "lucide-react";
import { useMemo, useRef, useState } from "react";
import { countSigned } from "../../store/assessment";
import { openText } from "../../store/goals";
import { exportTo, useJob } from "../../store/jobs";
import { useProject } from "../../store/project";
import { listExportable, solidText } from "../../store/reviews";
import { notify } from "../../store/toasts";
import { capitalize, countText } from "../../store/words";
import { Button, IconButton } from "../../ui/Button";
import { Choice } from "../../ui/fields";
import { Section } from "../../ui/Section";
import { useCalled } from "../../store/calls";
import { JobLines, JobNote, JobProgress } from "../../ui/JobProgress";
import css from "./review.module.css";

type What = "signed" | "all";

export function ExportSection() {
  const job = useJob("export");
  const running = job?.state === "running";
  return (
    <>
      <Section title="Export">
        {running ? <JobProgress job={job} unit="asset" /> : <Form />}
      </Section>
      {job && !running && (
        <Section title="The last export">
          <JobNote job={job} />
          {job.out && <Where folder={job.out} />}
          <JobLines lines={job.lines} />
        </Section>
      )}
    </>
  );
}

function Form() {
  const [what, setWhat] = useState<What>("signed");
  const [folder, setFolder] = useState("export");
  const button = useRef<HTMLButtonElement>(null);
  useCalled("export", () => button.current?.focus());
  const project = useProject((state) => state.project.folder);
  const cards = useProject((state) => state.cards);
  const confidence = useProject((state) => state.confidence);
  const goals = useProject(openText);
  const outputs = useMemo(() => listExportable(Object.values(cards), confidence), [cards, confidence]);
  const solid = useProject((state) => solidText(outputs[what], state));
  const count = outputs[what].length;
  const later = useProject(({ assessment }) => (assessment ? countSigned(assessment, cards) : 0)) - outputs.signed.length;
  const options = [
    { value: "signed", label: `Signed off (${outputs.signed.length})` },
    { value: "all", label: `All (${outputs.all.length})` },
  ] as const;
  const why = !count ? (what === "all" ? "Nothing is written yet: apply the program." : "Nothing that is written is signed off yet.") : null;
  return (
    <form
      className={css.form}
      onSubmit={(event) => {
        event.preventDefault();
        void exportTo(folder.trim(), what === "signed");
      }}
    >
      <span>Outputs</span>
      <Choice name="Which outputs" value={what} options={options} onChange={setWhat} />
      <label htmlFor="export-folder">Folder</label>
      <input id="export-folder" className={css.field} value={folder} onChange={(event) => setFolder(event.target.value)} spellCheck={false} />
      <span />
      <p className={css.dim}>{why ?? `Below ${project}.`}</p>
      {later > 0 && (
        <>
          <span />
          <p className={css.warn}>{later} more {later === 1 ? "is" : "are"} signed off, and not written as {later === 1 ? "it is" : "they are"} now: apply the program first.</p>
        </>
      )}
      {goals && (
        <>
          <span />
          <p className={css.warn}>{capitalize(goals)}.</p>
        </>
      )}
      {solid && (
        <>
          <span />
          <p className={css.warn}>
            {solid} After the export, write MJCF or URDF for them: <code>{`meshforge convert --to .xml ${project}/${folder.trim()} OUT`}</code>
          </p>
        </>
      )}
      <span />
      <Button ref={button} look="primary" icon={FolderOutput} type="submit" disabled={why !== null || !folder.trim()}>
        Export {countText(count, "asset")}
      </Button>
    </form>
  );
}

function Where({ folder }: { folder: string }) {
  const copy = () => navigator.clipboard.writeText(folder).then(() => notify("Path copied"));
  return (
    <div className={css.where}>
      <code>{folder}</code>
      <IconButton icon={Copy} name="Copy the path" onClick={() => void copy()} />
    </div>
  );
}
