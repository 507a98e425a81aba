// The edits by hand of an asset, which are done again after the program.
import { Undo2 } from "lucide-react";
import { perform } from "../store/edits";
import { light, unlight } from "../store/lighting";
import { splitAction } from "../store/stepWords";
import { Button } from "../ui/Button";
import type { AssetView, CorrectionView } from "../wire";
import { actionIcon } from "./actionLooks";
import css from "./steps.module.css";

export function Corrections({ view }: { view: AssetView }) {
  if (!view.corrections.length) {
    return <div className={css.line}>No edits by hand: this asset is what the program makes of it</div>;
  }
  return (
    <ol className={css.strip} aria-label="Edits by hand of this asset">
      <li className={css.title}>By hand, after the program:</li>
      {view.corrections.map((correction, k) => (
        <Correction key={k} view={view} correction={correction} place={k} />
      ))}
      <li>
        <Button look="quiet" icon={Undo2} onClick={() => void perform({ kind: "drop-corrections", asset: view.asset })}>
          Back to what the program makes of it
        </Button>
      </li>
    </ol>
  );
}

function Correction({ view, correction, place }: { view: AssetView; correction: CorrectionView; place: number }) {
  const { action, label } = splitAction(correction.action);
  const Icon = actionIcon(action);
  return (
    <li className={css.chip} onPointerEnter={() => light(view, correction.select)} onPointerLeave={unlight}>
      <span className={css.chipButton} title={correction.select.join(", ")}>
        <span className={css.number}>{place + 1}</span>
        <Icon size={14} aria-hidden />
        <span className={css.action}>{action}</span>
        <span className={css.amount}>×{correction.select.length}</span>
        {label && <span className={css.made}>{label}</span>}
      </span>
    </li>
  );
}
