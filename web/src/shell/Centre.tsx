// The middle of the window: the view of one asset with its steps below, or the whole family.
import { Gallery } from "../family/Gallery";
import { Nothing } from "./Nothing";
import { useLayout } from "../store/layout";
import { useProject } from "../store/project";
import css from "./App.module.css";
import { StepStrip, Viewport } from "./rooms";

export function Centre() {
  const gallery = useLayout((layout) => layout.gallery);
  const none = useProject((state) => state.order.length === 0);
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
