// Where the result is not right: edits by hand, going back to what the program makes, or demonstrating this asset.
import { GraduationCap, Hand, RotateCcw } from "lucide-react";
import { demonstrate } from "../../commands/learning";
import { beginCorrection, dropCorrections } from "../../commands/reviewing";
import { useDesk } from "../../store/desk";
import { useProject } from "../../store/project";
import { counted, listed } from "../../store/words";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import { CorrectForm } from "./CorrectForm";
import css from "./review.module.css";
import { useCorrections } from "./useCorrections";

export function Corrections({ asset }: { asset: string }) {
  const corrections = useCorrections(asset);
  const correcting = useDesk((state) => state.draft !== null);
  const program = useProject((state) => state.program.text.trim() !== "");
  const runs = useProject((state) => program && !state.reach[asset]?.error);
  if (!program && !corrections.length) return null;
  return (
    <Section title="Where the program is wrong" aside={corrections.length ? counted(corrections.length, "edit by hand", "edits by hand") : null}>
      {corrections.length > 0 && (
        <ol className={css.corrections}>
          {corrections.map(({ select, action }, k) => (
            <li key={k} title={select.join(", ")}>
              <code className={css.code}>{action}</code> <span className={css.dim}>{listed(select, 3)}</span>
            </li>
          ))}
        </ol>
      )}
      {correcting ? (
        <CorrectForm asset={asset} />
      ) : (
        <div className={css.row}>
          {runs && (
            <Button icon={Hand} tip="Mends this result alone; it is kept and done again after the program" onClick={() => beginCorrection(asset)}>
              Correct by hand
            </Button>
          )}
          <Button icon={GraduationCap} tip="Show the steps on this asset; the program is learned again" onClick={() => demonstrate(asset)}>
            Demonstrate this one
          </Button>
          {corrections.length > 0 && (
            <Button look="quiet" icon={RotateCcw} onClick={() => void dropCorrections(asset)}>
              Revert to what the program makes
            </Button>
          )}
        </div>
      )}
    </Section>
  );
}
