// One part of what is measured: its figures before and after, what was found, and pictures.
import { LoaderCircle, RotateCw } from "lucide-react";
import { again, type Part, partKey, useChecks } from "../../../store/checks";
import { useDesk } from "../../../store/desk";
import { counts } from "../../../store/faults";
import { figureText } from "../../../store/units";
import { counted, sentence } from "../../../store/words";
import type { Checked, Problem } from "../../../wire";
import { Button } from "../../../ui/Button";
import { Note } from "../../../ui/Section";
import { CheckFindings } from "./CheckFindings";
import css from "./checks.module.css";
import { CheckPictures } from "./CheckPictures";
import { EngineMenu } from "./EngineMenu";
import { FigureTable } from "./FigureTable";

const TITLES: Readonly<Record<Part, string>> = {
  fit: "Fit to what is seen",
  clearance: "Free space",
  physics: "At rest in MuJoCo",
  engines: "Limits of",
};

interface PartProps {
  asset: string;
  version: string;
  part: Part;
}

export function CheckPart({ asset, version, part }: PartProps) {
  const measured = useChecks((state) => state.parts[partKey(asset, version, part)]);
  return (
    <section className={css.part} aria-label={part === "engines" ? "Limits of an engine" : TITLES[part]}>
      <h4>
        {TITLES[part]} {part === "engines" && <EngineMenu />}
      </h4>
      {(!measured || measured.kind === "coming") && <Coming begun={measured !== undefined} />}
      {measured?.kind === "problem" && <Failed problem={measured.problem} onAgain={() => again(asset, version, part)} />}
      {measured?.kind === "there" && <There asset={asset} version={version} checked={measured.checked} />}
    </section>
  );
}

function Coming({ begun }: { begun: boolean }) {
  if (!begun) return <p className={css.dim}>…</p>;
  return (
    <p className={css.coming} role="status">
      <LoaderCircle size={14} aria-hidden className={css.spinning} /> measuring
    </p>
  );
}

function Failed({ problem, onAgain }: { problem: Problem; onAgain: () => void }) {
  return (
    <Note mood="bad">
      {problem.message}
      {problem.remedy && <p>{problem.remedy}</p>}
      <div className={css.again}>
        <Button icon={RotateCw} onClick={onAgain}>
          Try again
        </Button>
      </div>
    </Note>
  );
}

function There({ asset, version, checked }: { asset: string; version: string; checked: Checked }) {
  const { part, figures, findings, notes, gone, cell, pictured } = checked;
  const engine = useDesk((desk) => desk.checks.engine);
  // what is not legal has a section of its own
  const told = part === "engines" ? findings.filter((one) => one.engine !== null && counts(one, engine)) : findings;
  return (
    <>
      {figures.length > 0 && <FigureTable figures={figures} />}
      {notes.map((note) => (
        <p key={note} className={css.dim}>
          {sentence(note)}
        </p>
      ))}
      <CheckFindings asset={asset} findings={told} />
      {part === "engines" && engine !== "" && !told.length && <p className={css.good}>✓ Within all of them.</p>}
      {gone > 0 && <p className={css.good}>✓ {counted(gone, "finding")} about the asset before {gone === 1 ? "is" : "are"} gone.</p>}
      {pictured && <CheckPictures asset={asset} version={version} part={part} />}
      {cell !== null && <p className={css.dim}>Measured in cells of {figureText(cell, "m")}; what is smaller is not seen.</p>}
    </>
  );
}
