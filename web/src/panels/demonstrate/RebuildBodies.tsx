// Looking for hulls of all assets that hold more than one part: pictures to tick, of which the bodies are made anew.
import { Hammer, Search } from "lucide-react";
import { useState } from "react";
import { dismissSpanning, findSpanning, rebuildBodies, useJob, whyNotRebuild } from "../../store/jobs";
import { useOwnNames, useProject } from "../../store/project";
import { countText, listText } from "../../store/words";
import { visit } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Check } from "../../ui/fields";
import { Name } from "../../ui/Name";
import { Section } from "../../ui/Section";
import type { Job, JobLine } from "../../wire";
import { InSight } from "../questions/GroupHulls";
import questions from "../questions/questions.module.css";
import { JobLines, JobNote, JobProgress } from "../../ui/JobProgress";
import css from "./demonstrate.module.css";

export function RebuildBodies() {
  const job = useJob("rebuild");
  return (
    <Section title="Prepare all assets">
      {job?.state === "running" ? <JobProgress job={job} /> : <Ready job={job} />}
    </Section>
  );
}

function Ready({ job }: { job: Job | null }) {
  const why = useProject(whyNotRebuild);
  const [answered, setAnswered] = useState<string | null>(null);
  const found = job && job.id !== answered ? job.lines.filter(({ body }) => body !== null) : [];
  return (
    <div className={css.spans}>
      <div className={css.buttons}>
        <Button icon={Search} disabled={why !== null} onClick={() => void findSpanning()} tip="Hulls of all assets that hold more than one part; nothing is changed">
          Find hulls that span parts
        </Button>
      </div>
      {why !== null && <p className={css.hint}>{why}</p>}
      {job && job.id !== answered && (found.length > 0 ? <p>{job.message}</p> : <JobNote job={job} />)}
      {job && found.length > 0 && <FoundSheet key={job.id} found={found} onDismiss={() => setAnswered(job.id)} />}
      <JobLines lines={job?.lines.filter(({ body }) => body === null) ?? []} />
    </div>
  );
}

/** So many pictures are drawn at first, and so many more at a time. */
const PAGE = 24;

/** The bodies in which hulls were found, each as a picture to tick: those that are ticked are rebuilt, the others stay. */
function FoundSheet({ found, onDismiss }: { found: readonly JobLine[]; onDismiss: () => void }) {
  const [ticked, setTicked] = useState<ReadonlySet<JobLine>>(new Set());
  const [most, setMost] = useState(PAGE);
  const others = found.filter((line) => !ticked.has(line));
  const dismiss = async () => (await dismissSpanning(others)) && !ticked.size && onDismiss();
  const tick = (line: JobLine, is: boolean) => setTicked(new Set(is ? [...ticked, line] : [...ticked].filter((one) => one !== line)));
  return (
    <>
      <p className={css.hint}>Tick what is to be rebuilt into hulls of one part each; all else stays as it is.</p>
      <ul className={questions.group} aria-label="Hulls that may span parts" data-few={found.length < 3}>
        {found.slice(0, most).map((line) => (
          <Found key={`${line.asset} ${line.body}`} line={line} ticked={ticked.has(line)} onTick={(is) => tick(line, is)} />
        ))}
      </ul>
      <div className={css.buttons}>
        <Button look={ticked.size ? "plain" : "primary"} disabled={!others.length} onClick={() => void dismiss()} tip="They stay as they are, and are not found again; undo takes that back">
          {ticked.size ? "None of the others" : "None of these"}
        </Button>
        <Button icon={Hammer} look={ticked.size ? "primary" : "plain"} disabled={!ticked.size} onClick={() => void rebuildBodies([...ticked], !others.length)} tip="All hulls of each ticked body are made anew, each of one part; undo takes it back">
          Rebuild {countText(ticked.size, "ticked body", "ticked bodies")}
        </Button>
        {others.length > 0 && <Button look="quiet" onClick={() => setTicked(new Set(found))}>Tick all {found.length}</Button>}
        {found.length > most && <Button look="quiet" onClick={() => setMost(most + PAGE)}>Show {Math.min(PAGE, found.length - most)} more</Button>}
      </div>
    </>
  );
}

/** One body with its hulls that were found, in place on its asset, and why. */
function Found({ line, ticked, onTick }: { line: JobLine; ticked: boolean; onTick: (is: boolean) => void }) {
  const { asset, hulls, text } = line;
  const ownName = useOwnNames();
  const isSigned = useProject((state) => state.confidence[asset]?.state === "signed");
  return (
    <li className={questions.member} data-ticked={ticked}>
      <button type="button" className={questions.look} aria-label={`Open ${asset} with ${listText(hulls)} selected`} onClick={() => visit(asset, { kind: "source" }, hulls)}>
        <InSight asset={asset} names={hulls} />
      </button>
      <div className={css.found}>
        <Check checked={ticked} onChange={onTick}>
          <Name text={asset} own={ownName(asset)} />
        </Check>
        <p>{text}</p>
        {isSigned && <p className={css.hint}>signed off; found since</p>}
      </div>
    </li>
  );
}
