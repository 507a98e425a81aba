// What is pointed at, and how many hulls there are and are selected.
import { useDesk } from "../../store/desk";
import { useProject } from "../../store/project";
import { useFormerLabels } from "../../store/relabelled";
import { type Scene, useScenes } from "../../store/scenes";
import { counted } from "../../store/words";
import { Swatch } from "../../ui/Section";
import type { HullView } from "../../wire";
import { isUnsure } from "../colors/palette";
import { lengthText, volumeText } from "../shapes/nice";
import { useStage } from "../stage/context";
import css from "./overlay.module.css";

export function Hud() {
  return (
    <div className={css.hud}>
      <Pointed />
      <Unturned />
      <Counts />
    </div>
  );
}

function Unturned() {
  const why = useScenes(({ scene }) => (scene?.hulls.length ? scene.view.unturned : null));
  return why ? <div className={css.unturned}>Not turned: {why}</div> : null;
}

function Pointed() {
  const name = useDesk((desk) => desk.hover);
  const hull = useScenes(({ scene }) => scene?.hulls.find((one) => one.name === name));
  const piece = useScenes(({ scene }) => scene?.view.opaque.find((one) => one.name === name));
  if (hull) return <HullLine hull={hull} />;
  if (!piece) return null;
  return (
    <div className={css.pointed}>
      <b>{piece.name}</b>
      <span>{piece.reason}</span>
    </div>
  );
}

function HullLine({ hull }: { hull: HullView }) {
  const scene = useScenes((state) => state.scene);
  const was = useFormerLabels(scene?.asset ?? "", scene?.view.hulls ?? NONE).get(hull.name);
  const color = useProject(({ project }) => project.vocabulary.find((label) => label.name === hull.label)?.color);
  const share = hull.confidence === null ? "" : ` ${Math.round(100 * hull.confidence)} %`;
  return (
    <div className={css.pointed}>
      <b>{hull.name}</b>
      {hull.label === null ? (
        <span>no label</span>
      ) : (
        <span>
          <Swatch color={color ?? "var(--hull-unlabelled)"} hatched={isUnsure(hull)} /> {hull.label}
          {isUnsure(hull) ? `, unsure${share}` : share}
          {was !== undefined && `, was ${was}`}
        </span>
      )}
      <span>{volumeText(hull.volume)}</span>
      <span>{hull.primitive ?? `${hull.vertices} vertices`}</span>
    </div>
  );
}

const NONE: readonly HullView[] = [];

function Counts() {
  const scene = useScenes((state) => state.scene);
  const selected = useDesk((desk) => desk.selection.size);
  const hidden = useDesk((desk) => desk.hidden.size);
  const grid = useDesk((desk) => desk.view.grid);
  const stage = useStage();
  if (!scene) return null;
  const parts = [countText(scene), selected ? `${selected} selected` : "", hidden ? `${hidden} hidden` : ""];
  return (
    <div className={css.counts} data-testid="counts">
      <span>{parts.filter(Boolean).join(" · ")}</span>
      {grid && <span className={css.faint}>grid {lengthText(stage.contents.ground.step)}</span>}
    </div>
  );
}

function countText({ view, hulls, edit }: Scene): string {
  const before = view.hulls.length;
  return edit ? `${before} → ${counted(hulls.length, "hull")}` : counted(before, "hull");
}
