// The bottom of the window: the steps of the asset in hand, or, while reviewing, its edits by hand.
import { useDesk } from "../store/desk";
import { useAssetView } from "../store/hooks";
import { useProject } from "../store/project";
import { counted } from "../store/words";
import { Corrections } from "./Corrections";
import { Steps } from "./Steps";
import css from "./steps.module.css";

export function StepStrip() {
  const stage = useDesk((desk) => desk.stage);
  const view = useAssetView();
  const rules = useProject((state) => state.project.rules.length);
  if (!view) return <div className={css.strip} />;
  if (stage === "review") return <Corrections view={view} />;
  const said = view.steps.filter((step) => step.select !== null).length;
  if (stage === "label") {
    return (
      <div className={css.line}>
        {said ? `${counted(said, "step")} shown on this asset` : "No steps on this asset yet"}
      </div>
    );
  }
  return <Steps view={view} count={Math.max(rules, view.steps.length)} />;
}
