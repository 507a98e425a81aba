// The stage in which hulls get labels: the vocabulary, the walk through labels that nobody gave, and ways to get labels.
import { Check, ChevronRight } from "lucide-react";
import { fillOf } from "../../pictures/hullColors";
import { hullNamesOf } from "../../store/commonParts";
import { confirmLabels, labelProgress, placeInWalk, walk } from "../../store/labelWalk";
import { useProject } from "../../store/project";
import { useScenes } from "../../store/scenes";
import { sourceText } from "../../store/words";
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
      <Walk />
      <GetLabels />
    </div>
  );
}

/** How many labels are given, guessed and unsure; hulls of which nobody gave it, one after the other, and the one selected. */
function Walk() {
  const { hulls, labelled, given, guessed, unsure } = labelProgress(useProject((state) => state.cards));
  const inHand = useHullInHand();
  if (!hulls) return null;
  const next = given < hulls && (
    <Button icon={ChevronRight} onClick={() => void walk()} tip="The hull whose label is least sure, then the next" keys="N">
      Next
    </Button>
  );
  const counts = [[given, "given"], [guessed, "guessed"], [unsure, "unsure"], [hulls - labelled, "without a label"]] as const;
  const title = counts.flatMap(([count, what]) => (count ? `${count.toLocaleString("en-GB")} ${what}` : [])).join(", ");
  return (
    <Section title={title} aside={next}>
      <span className={css.meter} aria-hidden>
        {counts.map(([count, what]) => count > 0 && <i key={what} data-what={what} style={{ flexGrow: count }} />)}
      </span>
      {inHand && <HullInHand {...inHand} />}
    </Section>
  );
}

function HullInHand({ hull, at, of }: NonNullable<ReturnType<typeof useHullInHand>>) {
  const color = useProject((state) => state.project.vocabulary.find(({ name }) => name === hull.label)?.color);
  const short = useScenes(({ scene }) => (scene ? hullNamesOf(scene)(hull.name) : hull.name));
  const sure = hull.confidence === null ? "no label" : `${hull.confidence.toFixed(2)} sure`;
  return (
    <Note>
      <div className={css.doubtful}>
        <Swatch color={color ?? "var(--hull-unlabelled)"} fill={fillOf(hull)} />
        <span role="status">
          <strong>{hull.label ?? (hull.look ? "no part" : "No label")}</strong>
          {hull.look && "?"} <span title={hull.name}>{short}</span>
          <br />
          hull {(at + 1).toLocaleString("en-GB")} of {of.toLocaleString("en-GB")}, {[sure, hull.source && sourceText(hull.source)].filter(Boolean).join(", ")}
        </span>
        {hull.look && (
          <Button look="primary" icon={Check} onClick={() => void confirmLabels()} tip="Confirm the label and go to the next" keys="Enter">
            Right
          </Button>
        )}
      </div>
      <p className={css.hint}>{hull.look ? "Not right? Press" : "Press"} its number, or click the label.</p>
    </Note>
  );
}

/** The hull that alone is selected, where nobody gave its label. */
function useHullInHand() {
  const name = useWorkspace((workspace) => (workspace.selection.size === 1 ? [...workspace.selection][0] : undefined));
  const scene = useScenes((state) => state.scene);
  const cards = useProject((state) => state.cards);
  const hull = scene?.hulls.find((one) => one.name === name);
  const place = scene && hull ? placeInWalk(cards, scene.asset, scene.view.hulls, hull.name) : null;
  return hull && place ? { hull, ...place } : null;
}
