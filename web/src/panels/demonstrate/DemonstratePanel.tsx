// The stage in which a person shows what to do: the action in hand, the family's rules, orientation, preparation.
import { Boxes, Slice, Undo2 } from "lucide-react";
import { useEffect } from "react";
import { startCut } from "../../commands/demonstrate";
import { perform } from "../../store/edits";
import { followGuesses } from "../../store/guesses";
import { openDecompose } from "../../store/decompose";
import { useIsDecomposing } from "../../store/jobs";
import { followPreview } from "../../store/preview";
import { useProject } from "../../store/project";
import { useAssetView } from "../../store/scenes";
import { countText } from "../../store/words";
import { setTool, useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import css from "./demonstrate.module.css";
import { DraftForm } from "./DraftForm";
import { FamilyRules } from "./FamilyRules";
import { RebuildBodies } from "./RebuildBodies";
import { Orientation } from "./Orientation";

export function DemonstratePanel() {
  useEffect(() => followPreview(false), []);
  useEffect(followGuesses, []);
  return (
    <div className={css.panel} data-tour="demonstrate">
      <Section title="What to do with the selected hulls">
        <DraftForm />
      </Section>
      <FamilyRules />
      <Orientation />
      <Preparation />
      <RebuildBodies />
    </div>
  );
}

/** What is done to an asset before any program sees it: hulls are split, pieces without hulls get some. */
function Preparation() {
  const view = useAssetView();
  if (!view) return null;
  return (
    <Section title="Prepare this asset">
      <div className={css.buttons}>
        <Split />
        <Decompose asset={view.asset} pieces={view.non_convex.length} />
      </div>
      {view.prepared.length > 0 && (
        <>
          <ol className={css.prepared}>
            {view.prepared.map((line, k) => (
              <li key={k}>{line}</li>
            ))}
          </ol>
          <Button icon={Undo2} onClick={() => void perform({ kind: "unprepare", asset: view.asset })}>
            Undo the last
          </Button>
        </>
      )}
    </Section>
  );
}

function Split() {
  const cutting = useWorkspace((workspace) => workspace.tool === "cut");
  const one = useWorkspace((workspace) => workspace.selection.size === 1);
  if (cutting) return <Button onClick={() => setTool("select")}>Stop splitting</Button>;
  if (!one) return <p className={css.hint}>To split a hull by a plane, select only that hull.</p>;
  return (
    <Button icon={Slice} onClick={startCut} tip="By a plane, before any step" keys="K">
      Split the selected hull
    </Button>
  );
}

/** Pieces that are no hulls can be made into hulls. */
function Decompose({ asset, pieces }: { asset: string; pieces: number }) {
  const sources = useProject((state) => state.cards[asset]?.sources ?? 0);
  const busy = useIsDecomposing();
  if (!sources) return null;
  const what = pieces ? countText(pieces, "piece") : "geometry without hulls";
  return (
    <Button icon={Boxes} disabled={busy} onClick={() => openDecompose(asset)} tip="Decompose geometry without hulls into convex hulls">
      {busy ? "Making hulls…" : `Make hulls of ${what}`}
    </Button>
  );
}
