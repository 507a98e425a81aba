// Where the result is not right: edits by hand, going back to what the program makes, or demonstrating this asset.
import { GraduationCap, Hand, RotateCcw } from "lucide-react";
import { useEffect } from "react";
import { demonstrate } from "../../commands/learn";
import { dropCorrections, showPresent, startCorrection } from "../../commands/review";
import { DraftForm } from "../demonstrate/DraftForm";
import { followPreview } from "../../store/preview";
import { useProject } from "../../store/project";
import { getDetails } from "../../store/scenes";
import { countText, listText } from "../../store/words";
import { useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import { useAnswer } from "../../ui/useAnswer";
import type { ManualEditView } from "../../wire";
import css from "./review.module.css";

export function Corrections({ asset }: { asset: string }) {
  const corrections = useCorrections(asset);
  const correcting = useWorkspace((state) => state.draft !== null);
  const program = useProject((state) => state.program.text.trim() !== "");
  const runs = useProject((state) => program && !state.reach[asset]?.error);
  if (!program && !corrections.length) return null;
  return (
    <Section title="Where the program is wrong" aside={corrections.length ? countText(corrections.length, "edit by hand", "edits by hand") : null}>
      {corrections.length > 0 && (
        <ol className={css.corrections}>
          {corrections.map(({ select, action }, k) => (
            <li key={k} title={select.join(", ")}>
              <code className={css.code}>{action.text}</code> <span className={css.dim}>{listText(select, 3)}</span>
            </li>
          ))}
        </ol>
      )}
      {correcting ? (
        <CorrectForm asset={asset} />
      ) : (
        <div className={css.row}>
          {runs && (
            <Button icon={Hand} tip="Fixes only this result; the edit is repeated after the program" onClick={() => startCorrection(asset)}>
              Correct by hand
            </Button>
          )}
          <Button icon={GraduationCap} tip="Demonstrate the steps on this asset; the program is learned again" onClick={() => demonstrate(asset)}>
            Demonstrate this asset
          </Button>
          {corrections.length > 0 && (
            <Button look="quiet" icon={RotateCcw} onClick={() => void dropCorrections(asset)}>
              Revert to the program's result
            </Button>
          )}
        </div>
      )}
    </Section>
  );
}

/** The action in hand, done to the result: a preview, and Enter keeps it as an edit by hand. */
function CorrectForm({ asset }: { asset: string }) {
  useEffect(() => {
    // hulls are named as the program leaves them now, so that is what must be in view
    const { showing } = useWorkspace.getState();
    if (showing.kind !== "result" || showing.of !== "program") showPresent(asset);
    return followPreview(true);
  }, [asset]);
  return (
    <div className={css.correcting} ref={toView}>
      <p className={css.dim}>Select hulls of the result. The edit applies to this asset only and is repeated after the program.</p>
      <DraftForm />
    </div>
  );
}

function toView(form: HTMLElement | null): void {
  form?.scrollIntoView({ block: "nearest" });
}

const NONE: readonly ManualEditView[] = [];

/** The edits by hand of an asset, also where its result fails. The viewport reports one that cannot be read. */
function useCorrections(asset: string): readonly ManualEditView[] {
  const revision = useProject((state) => state.revisions[asset] ?? 0);
  return useAnswer(`${asset} ${revision}`, () => getDetails(asset).catch(() => null))?.view.manual_edits ?? NONE;
}
