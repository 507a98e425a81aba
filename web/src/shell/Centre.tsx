// The middle of the window: the view of one asset with its steps below, or the whole family.
import { Gallery } from "../family/Gallery";
import { StepStrip } from "../steps/StepStrip";
import { useLayout } from "../store/layout";
import { useProject } from "../store/project";
import { Viewport } from "../viewport/Viewport";
import css from "./App.module.css";
import { Nothing } from "./Nothing";

export function Centre() {
  const gallery = useLayout((layout) => layout.gallery);
  const none = useProject(({ cards }) => Object.values(cards).every((card) => card.error !== null));
  if (none) return <Nothing />;
  return (
    <main className={css.centre}>
      <div className={css.view} data-part data-tour="view">
        {gallery ? <Gallery /> : <Viewport />}
      </div>
      {!gallery && (
        <div className={css.steps} data-part data-tour="steps">
          <StepStrip />
        </div>
      )}
    </main>
  );
}
