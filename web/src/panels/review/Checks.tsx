// What is measured of the written output beside the asset: fit, clearance, rest, and the limits of an engine.
import { ChevronDown, ChevronRight, RotateCw } from "lucide-react";
import { useEffect } from "react";
import {
  concerns,
  countByEdit,
  faultsOf,
  findingsText,
  measure,
  type Part,
  partKey,
  PARTS,
  retryPart,
  useChecks,
} from "../../store/checks";
import { useProject } from "../../store/project";
import { figureText, textIn } from "../../store/units";
import { countText, toSentence } from "../../store/words";
import { setChecks, useUnit, useWorkspace } from "../../store/workspace";
import { Button, Tip } from "../../ui/Button";
import { choiceLines, Menu } from "../../ui/Menu";
import { ProblemNote } from "../../ui/Section";
import ui from "../../ui/ui.module.css";
import type { CheckResult } from "../../wire";
import { CheckFindings } from "./CheckFindings";
import { CheckPictures, Coming } from "./CheckPictures";
import css from "./checks.module.css";
import { FigureTable } from "./FigureTable";

export function Checks({ asset }: { asset: string }) {
  const version = useProject((state) => state.cards[asset]?.check ?? null);
  const open = useWorkspace((workspace) => workspace.checks.open);
  if (version === null) return null;
  const Icon = open ? ChevronDown : ChevronRight;
  return (
    <section className={ui.section} aria-label="Checks">
      <header className={ui.sectionHead}>
        <Tip text="Compares the output with the original: engine limits, rest, free space, fit" keys="Shift+C">
          <button type="button" className={css.toggle} aria-expanded={open} onClick={() => setChecks({ open: !open })}>
            <Icon size={14} aria-hidden /> <h3>Checks</h3>
          </button>
        </Tip>
        <div className={ui.sectionAside}>
          <ChecksState asset={asset} />
        </div>
      </header>
      {open && <Parts key={version} asset={asset} version={version} />}
    </section>
  );
}

function Parts({ asset, version }: { asset: string; version: string }) {
  const tries = useChecks((state) => state.tries);
  useEffect(() => measure(asset, version), [asset, version, tries]);
  const other = useWorkspace(({ showing }) => !(showing.kind === "result" && showing.of === "output"));
  return (
    <div className={css.parts}>
      {other && <p className={css.dim}>These checks are of the written output; the view shows the current program's result.</p>}
      {[...PARTS].reverse().map((part) => (
        <CheckPart key={part} asset={asset} version={version} part={part} />
      ))}
    </div>
  );
}

/** What was found, once all is measured. */
function ChecksState({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  const engine = useWorkspace((workspace) => workspace.checks.engine);
  if (!card || card.faults === null) return <span className={css.dim}>not measured</span>;
  const faults = faultsOf(card, engine);
  if (!faults.length) return <span className={css.good}>✓ nothing found</span>;
  const fresh = countByEdit(faults);
  return (
    <span className={fresh ? css.warn : undefined} title={findingsText(faults)}>
      {countText(faults.length, "finding")}
      {fresh > 0 && fresh < faults.length && `, ${fresh} by the edit`}
    </span>
  );
}

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

/** One part of what is measured: its figures before and after, what was found, and pictures. */
function CheckPart({ asset, version, part }: PartProps) {
  const measured = useChecks((state) => state.parts[partKey(asset, version, part)]);
  return (
    <section className={css.part} aria-label={part === "engines" ? "Limits of an engine" : TITLES[part]}>
      <h4>
        {TITLES[part]} {part === "engines" && <EngineMenu />}
      </h4>
      {!measured && <p className={css.dim}>…</p>}
      {measured?.kind === "coming" && <Coming what="measuring" />}
      {measured?.kind === "problem" && (
        <ProblemNote {...measured.problem}>
          <div className={css.again}>
            <Button icon={RotateCw} onClick={() => retryPart(asset, version, part)}>
              Try again
            </Button>
          </div>
        </ProblemNote>
      )}
      {measured?.kind === "there" && <PartResult asset={asset} checked={measured.checked} />}
    </section>
  );
}

function PartResult({ asset, checked }: { asset: string; checked: CheckResult }) {
  const { part, figures, findings, notes, gone, cell, pictured } = checked;
  const engine = useWorkspace((workspace) => workspace.checks.engine);
  const units = useUnit();
  const rows = figures.map(({ what, unit, before, after }) => ({
    what,
    before: before === null ? "" : figureText(before, unit, units),
    after: figureText(after, unit, units),
  }));
  // what is not legal has a section of its own
  const shown = part === "engines" ? findings.filter((one) => one.engine !== null && concerns(one, engine)) : findings;
  return (
    <>
      {rows.length > 0 && <FigureTable rows={rows} />}
      {notes.map((note) => (
        <p key={note} className={css.dim}>
          {toSentence(textIn(note, units))}
        </p>
      ))}
      <CheckFindings asset={asset} findings={shown} />
      {part === "engines" && engine !== "" && !shown.length && <p className={css.good}>✓ Within all of them.</p>}
      {gone > 0 && <p className={css.good}>✓ {countText(gone, "finding")} of the original asset {gone === 1 ? "is" : "are"} gone.</p>}
      {pictured && <CheckPictures asset={asset} part={part} />}
      {cell !== null && <p className={css.dim}>Measured in cells of {figureText(cell, "m", units)}: smaller details are missed.</p>}
    </>
  );
}

/** Whose limits are looked at. */
function EngineMenu() {
  const engine = useWorkspace((workspace) => workspace.checks.engine);
  const engines = useProject((state) => state.engines);
  const title = engines[engine] ?? "no engine";
  return (
    <Menu
      trigger={
        <Button className={css.engine} aria-label={`Limits of ${title}`}>
          {title}
          <ChevronDown size={13} aria-hidden />
        </Button>
      }
      lines={choiceLines<string>({ "": "No engine", ...engines }, engine, (name) => setChecks({ engine: name }))}
    />
  );
}
