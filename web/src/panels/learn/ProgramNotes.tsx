// What must be known about the program before reading it: damaged, by hand, out of date, failing somewhere.
import { learnNow } from "../../commands/learning";
import { visit } from "../../store/desk";
import { learnedDiffers } from "../../store/lessons";
import { useProject } from "../../store/project";
import { counted, errorParts, shortName } from "../../store/words";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import css from "./learn.module.css";

export function ProgramNotes() {
  const program = useProject((state) => state.program);
  const problem = useProject((state) => state.project.problem);
  return (
    <div className={css.notes}>
      {program.error && <Note mood="bad">The program cannot be read: {program.error}</Note>}
      {problem && problem !== program.error && <Note mood="bad">{problem}</Note>}
      {program.by_hand && program.text !== "" && <ByHand />}
      {program.outdated && !program.by_hand && <Outdated />}
      <Overruled />
      <Fails />
    </div>
  );
}

/** Which accepted results no program keeps. */
function Overruled() {
  const overruled = useProject((state) => state.lesson?.overruled);
  const first = overruled?.[0];
  if (!first) return null;
  const some = overruled.length === 1 ? `the accepted result of ${shortName(first)}` : `${overruled.length} accepted results`;
  return <Note mood="warn">No program does what is demonstrated and keeps {some}: it was learned without, look there again.</Note>;
}

function ByHand() {
  const differs = useProject((state) => learnedDiffers(state.program, state.lesson));
  return (
    <Note>
      <div className={css.split}>
        <span>Written by hand; lessons don’t change it.</span>
        {differs && <Button onClick={() => void learnNow()}>Use the learned one</Button>}
      </div>
    </Note>
  );
}

function Outdated() {
  const learning = useProject((state) => state.learning);
  if (learning) return null;
  return <Note mood="warn">Out of date: what it was learned from has changed, and nothing new could be learned yet.</Note>;
}

/** Where the program does not run. */
function Fails() {
  const reach = useProject((state) => state.reach);
  const failing = Object.values(reach).filter((row) => row.error !== null);
  const first = failing[0];
  if (!first) return null;
  return (
    <Note mood="warn">
      <div className={css.split}>
        <span>
          Does not run on {counted(failing.length, "asset")}, first {shortName(first.asset)}: {errorParts(first.error ?? "", first.asset).message}.
        </span>
        <Button look="quiet" onClick={() => visit(first.asset, { kind: "source" })}>
          Open
        </Button>
      </div>
    </Note>
  );
}
