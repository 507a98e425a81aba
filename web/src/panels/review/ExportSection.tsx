// Copying outputs into a folder, and where they lie then.
import { Copy, FolderOutput } from "lucide-react";
import { useState } from "react";
import { exportTo } from "../../store/jobs";
import { useProject } from "../../store/project";
import { exportable } from "../../store/reviews";
import { complainedOf, told } from "../../store/toasts";
import { counted } from "../../store/words";
import type { Job } from "../../wire";
import { Button, IconButton } from "../../ui/Button";
import { Choice } from "../../ui/Choice";
import { Note, Section } from "../../ui/Section";
import { JobLines } from "./JobLines";
import { JobProgress } from "./JobProgress";
import css from "./review.module.css";
import { useJob } from "./useJob";

type What = "accepted" | "all";

export function ExportSection() {
  const job = useJob("export");
  const running = job?.state === "running";
  return (
    <>
      <Section title="Export">{running ? <JobProgress job={job} unit="asset" /> : <Form />}</Section>
      {job && !running && <Outcome job={job} />}
    </>
  );
}

function Form() {
  const [folder, setFolder] = useState("export");
  const [what, setWhat] = useState<What>("accepted");
  const project = useProject((state) => state.project.folder);
  const counts = {
    accepted: useProject((state) => exportable(Object.values(state.cards), true)),
    all: useProject((state) => exportable(Object.values(state.cards), false)),
  };
  const options = [
    { value: "accepted", label: `Accepted (${counts.accepted})` },
    { value: "all", label: `All (${counts.all})` },
  ] as const;
  const why = !counts[what] ? (what === "all" ? "Nothing is written yet: apply the program." : "Nothing is accepted yet.") : null;
  return (
    <form
      className={css.form}
      onSubmit={(event) => {
        event.preventDefault();
        void exportTo(folder.trim(), what === "accepted");
      }}
    >
      <span>Outputs</span>
      <Choice name="Which outputs" value={what} options={options} onChange={setWhat} />
      <label htmlFor="export-folder">Folder</label>
      <input id="export-folder" className={css.field} value={folder} onChange={(event) => setFolder(event.target.value)} spellCheck={false} />
      <span />
      <p className={css.dim}>{why ?? `Below ${project}.`}</p>
      <span />
      <Button look="primary" icon={FolderOutput} type="submit" disabled={why !== null || !folder.trim()}>
        Export {counted(counts[what], "asset")}
      </Button>
    </form>
  );
}

function Outcome({ job }: { job: Job }) {
  const moods = { done: "good", failed: "bad", cancelled: "warn", running: "plain" } as const;
  const message = job.message || (job.state === "cancelled" ? "Stopped." : "Done.");
  return (
    <Section title="The last export">
      <Note mood={moods[job.state]}>{message}</Note>
      {job.out && <Where folder={job.out} />}
      <JobLines lines={job.lines} />
    </Section>
  );
}

function Where({ folder }: { folder: string }) {
  const copy = () => navigator.clipboard.writeText(folder).then(() => told("Path copied"), complainedOf);
  return (
    <div className={css.where}>
      <code>{folder}</code>
      <IconButton icon={Copy} name="Copy the path" onClick={() => void copy()} />
    </div>
  );
}
