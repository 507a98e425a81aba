// What is pointed at, and how many hulls there are and are selected.
import { fillOf, PALETTE } from "../../pictures/hullColors";
import { useStage } from "../stage/context";
import { useAlike } from "../../store/alike";
import { hullNamesOf } from "../../store/commonParts";
import { useProject } from "../../store/project";
import { type Scene, useScenes } from "../../store/scenes";
import { lengthText, volumeText } from "../../store/units";
import { countText } from "../../store/words";
import { useUnit, useWorkspace } from "../../store/workspace";
import { Swatch } from "../../ui/Section";
import type { HullView } from "../../wire";
import css from "./overlay.module.css";

export function InfoLines() {
  const why = useScenes(({ scene }) => (scene?.hulls.length ? scene.view.unturned : null));
  return (
    <div className={css.hud}>
      <PointedHull />
      {why && <div className={css.unturned}>Not oriented: {why}</div>}
      <Counts />
    </div>
  );
}

function PointedHull() {
  const name = useWorkspace((workspace) => workspace.hover);
  const hull = useScenes(({ scene }) => scene?.hulls.find((one) => one.name === name));
  const piece = useScenes(({ scene }) => scene?.view.non_convex.find((one) => one.name === name));
  if (hull) return <HullLine hull={hull} />;
  if (!piece) return null;
  return (
    <div className={css.pointed} data-testid="pointed">
      <b>{piece.name}</b>
      <span>{piece.reason}</span>
    </div>
  );
}

function HullLine({ hull }: { hull: HullView }) {
  const color = useProject(({ project }) => project.vocabulary.find((label) => label.name === hull.label)?.color);
  const unit = useUnit();
  const short = useScenes(({ scene }) => (scene ? hullNamesOf(scene)(hull.name) : hull.name));
  const alike = useAlike((state) => (state.hull === hull.name ? state.others.length : 0));
  const share = hull.confidence === null ? "" : ` ${Math.round(100 * hull.confidence)} %`;
  return (
    <div className={css.pointed} data-testid="pointed">
      <b title={hull.name}>{short}</b>
      {hull.look === null ? (
        <span>no label</span>
      ) : (
        <span>
          <Swatch color={color ?? "var(--hull-unlabelled)"} fill={fillOf(hull)} /> {hull.label ?? "no part"}, {hull.look}
          {hull.look !== "given" && share}
        </span>
      )}
      <span>{volumeText(hull.volume, unit)}</span>
      <span>{hull.primitive ?? `${hull.vertices} vertices`}</span>
      {alike > 0 && <span>a click paints it and {alike} like it, Alt+click it alone</span>}
    </div>
  );
}

function Counts() {
  const scene = useScenes((state) => state.scene);
  const selected = useWorkspace((workspace) => workspace.selection.size);
  const hidden = useWorkspace((workspace) => workspace.hidden.size);
  const grid = useWorkspace((workspace) => workspace.view.grid);
  const unit = useUnit();
  const stage = useStage();
  if (!scene) return null;
  const parts = [hullCountText(scene), selected ? `${selected} selected` : "", hidden ? `${hidden} hidden` : ""];
  return (
    <div className={css.counts} data-testid="counts">
      <span>{parts.filter(Boolean).join(" · ")}</span>
      {grid && <span className={css.faint}>grid {lengthText(stage.contents.ground.step, unit)}</span>}
    </div>
  );
}

function hullCountText({ view, hulls, edit }: Scene): string {
  const before = view.hulls.length;
  return edit ? `${before} → ${countText(hulls.length, "hull")}` : countText(before, "hull");
}

const MOST = 10;

/** What the colours mean where that is not shown elsewhere. */
export function Legend() {
  const colorBy = useWorkspace((workspace) => workspace.view.colorBy);
  const bodies = useScenes(({ scene }) => scene?.view.bodies);
  if (colorBy === "label") return <Fills />;
  if (colorBy !== "body" || !bodies) return null;
  return (
    <ul className={css.legend} aria-label="Colours of the bodies">
      {bodies.slice(0, MOST).map((body, k) => (
        <li key={body}>
          <Swatch color={PALETTE[k % PALETTE.length] ?? ""} /> {body}
        </li>
      ))}
      {bodies.length > MOST && <li>and {bodies.length - MOST} more</li>}
    </ul>
  );
}

/** What dots and stripes mean, where there are some. */
function Fills() {
  const isGuessed = useScenes(({ scene }) => scene?.hulls.some(({ look }) => look === "guessed" || look === "unsure"));
  return isGuessed ? (
    <ul className={css.legend} aria-label="How labels are shown">
      {(["given", "guessed", "unsure"] as const).map((look) => (
        <li key={look}>
          <Swatch color="var(--hull-unlabelled)" fill={fillOf({ look })} /> {look}
        </li>
      ))}
    </ul>
  ) : null;
}
