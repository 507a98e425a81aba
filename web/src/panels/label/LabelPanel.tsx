// The stage in which hulls get labels: the vocabulary, what is not sure, and ways to get labels.
import { Check, ChevronRight } from "lucide-react";
import { sureText } from "../../store/assessment";
import { useProject } from "../../store/project";
import { type SceneHull, useScenes } from "../../store/scenes";
import { confirmLabels, goToUnsure, isUnsure, labelProgress } from "../../store/unsureHulls";
import { countText, sourceText } from "../../store/words";
import { useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import { Note, Section, Swatch } from "../../ui/Section";
import css from "./label.module.css";
import { Vocabulary } from "./Vocabulary";
import { GetLabels } from "./GetLabels";

export function LabelPanel() {
  return (
    <div className={css.panel} data-tour="labels">
      <Vocabulary />
      <UnsureHulls />
      <GetLabels />
    </div>
  );
}

/** Hulls whose label is not sure, one after the other, and the one that is selected. */
function UnsureHulls() {
  const cards = useProject((state) => state.cards);
  const { unsure, assets } = labelProgress(cards);
  const doubtful = useUnsureHull();
  if (!unsure) return null;
  const next = (
    <Button icon={ChevronRight} onClick={() => void goToUnsure()} tip="Next unsure hull" keys="N">
      Next
    </Button>
  );
  return (
    <Section title={`${countText(unsure, "hull")} unsure on ${countText(assets, "asset")}`} aside={next}>
      {doubtful && <UnsureHull hull={doubtful} />}
    </Section>
  );
}

function UnsureHull({ hull }: { hull: SceneHull }) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === hull.label)?.color);
  const sure = hull.confidence === null ? null : sureText(hull.confidence);
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
          tip="Confirm the label and go to the next"
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
function useUnsureHull(): SceneHull | null {
  const name = useWorkspace((workspace) => (workspace.selection.size === 1 ? [...workspace.selection][0] : undefined));
  const scene = useScenes((state) => state.scene);
  const card = useProject((state) => state.cards[scene?.asset ?? ""]);
  if (!scene || name === undefined || !isUnsure(card, scene.view.hulls, name)) return null;
  return scene.hulls.find((hull) => hull.name === name && hull.label !== null) ?? null;
}
