// Hulls whose label is not sure, one after the other, and the one that is selected.
import { Check, ChevronRight } from "lucide-react";
import { useDesk } from "../../store/desk";
import { useProject } from "../../store/project";
import { confirmLabels, goToUnsure } from "../../store/queue";
import { type SceneHull, useScenes } from "../../store/scenes";
import { isUnsure, labelProgress } from "../../store/unsure";
import { counted, sourceText } from "../../store/words";
import { Button } from "../../ui/Button";
import { Note, Section, Swatch } from "../../ui/Section";
import css from "./label.module.css";

export function Unsure() {
  const cards = useProject((state) => state.cards);
  const { unsure, assets } = labelProgress(cards);
  const doubtful = useDoubtful();
  if (!unsure) return null;
  const next = (
    <Button icon={ChevronRight} onClick={() => void goToUnsure()} tip="Next unsure hull" keys="N">
      Next
    </Button>
  );
  return (
    <Section title={`${counted(unsure, "hull")} unsure on ${counted(assets, "asset")}`} aside={next}>
      {doubtful && <Doubtful hull={doubtful} />}
    </Section>
  );
}

function Doubtful({ hull }: { hull: SceneHull }) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === hull.label)?.color);
  const sure = hull.confidence === null ? null : `${Math.round(100 * hull.confidence)}% sure`;
  return (
    <Note>
      <div className={css.doubtful}>
        <Swatch color={color ?? "var(--hull-unlabelled)"} hatched={(hull.confidence ?? 1) < 0.5} />
        <span>
          <strong>{hull.label}</strong>? {hull.name}
          <br />
          {[sure, sourceText(hull.source ?? "")].filter(Boolean).join(", ")}
        </span>
        <Button
          look="primary"
          icon={Check}
          onClick={() => void confirmLabels()}
          tip="It is right; go on to the next"
          keys="Enter"
        >
          Right
        </Button>
      </div>
      <p className={css.hint}>Not right? Press its number, or click the label.</p>
    </Note>
  );
}

/** The hull that alone is selected, where its label is not sure. */
function useDoubtful(): SceneHull | null {
  const name = useDesk((desk) => (desk.selection.size === 1 ? [...desk.selection][0] : undefined));
  const scene = useScenes((state) => state.scene);
  const card = useProject((state) => state.cards[scene?.asset ?? ""]);
  if (!scene || name === undefined || !isUnsure(card, scene.view.hulls, name)) return null;
  return scene.hulls.find((hull) => hull.name === name && hull.label !== null) ?? null;
}
