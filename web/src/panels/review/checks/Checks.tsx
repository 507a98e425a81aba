// What is measured of the written output beside the asset: fit, clearance, rest, and the limits of an engine.
import { ChevronDown, ChevronRight } from "lucide-react";
import { useEffect } from "react";
import { measure, PARTS, useChecks } from "../../../store/checks";
import { setChecks, useDesk } from "../../../store/desk";
import { byEdit, faultsOf, foundText } from "../../../store/faults";
import { useProject } from "../../../store/project";
import { counted } from "../../../store/words";
import { Tip } from "../../../ui/Tip";
import ui from "../../../ui/ui.module.css";
import css from "./checks.module.css";
import { CheckPart } from "./CheckPart";

export function Checks({ asset }: { asset: string }) {
  const version = useProject((state) => state.cards[asset]?.check ?? null);
  const open = useDesk((desk) => desk.checks.open);
  if (version === null) return null;
  const Icon = open ? ChevronDown : ChevronRight;
  return (
    <section className={ui.section} aria-label="Checks">
      <header className={ui.sectionHead}>
        <Tip text="Measures the output beside the asset: limits of an engine, rest, free space, fit" keys="Shift+C">
          <button type="button" className={css.toggle} aria-expanded={open} onClick={() => setChecks({ open: !open })}>
            <Icon size={14} aria-hidden /> <h3>Checks</h3>
          </button>
        </Tip>
        <div className={ui.sectionAside}>
          <Standing asset={asset} />
        </div>
      </header>
      {open && <Parts key={version} asset={asset} version={version} />}
    </section>
  );
}

function Parts({ asset, version }: { asset: string; version: string }) {
  const tries = useChecks((state) => state.tries);
  useEffect(() => measure(asset, version), [asset, version, tries]);
  const other = useDesk(({ showing }) => !(showing.kind === "result" && showing.of === "output"));
  return (
    <div className={css.parts}>
      {other && <p className={css.dim}>Of the written output; what is in view is what the program makes now.</p>}
      {[...PARTS].reverse().map((part) => (
        <CheckPart key={part} asset={asset} version={version} part={part} />
      ))}
    </div>
  );
}

/** What was found, once all is measured. */
function Standing({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  const engine = useDesk((desk) => desk.checks.engine);
  if (!card || card.faults === null) return <span className={css.dim}>not measured</span>;
  const faults = faultsOf(card, engine);
  if (!faults.length) return <span className={css.good}>✓ nothing found</span>;
  const fresh = byEdit(faults);
  return (
    <span className={fresh ? css.warn : undefined} title={foundText(faults)}>
      {counted(faults.length, "finding")}
      {fresh > 0 && fresh < faults.length && `, ${fresh} by the edit`}
    </span>
  );
}
