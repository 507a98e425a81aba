// Keeps the stage in step with the stores and the theme.
import { api } from "../../server/api";
import { useCutting } from "../../store/cutting";
import { type DeskState, useDesk } from "../../store/desk";
import { forgetGone } from "../../store/hiding";
import { usePreview } from "../../store/preview";
import { useProject } from "../../store/project";
import { watchRelabelled } from "../../store/relabelled";
import { sceneOf, type Scene, useScenes } from "../../store/scenes";
import { complainedOf } from "../../store/toasts";
import { appearances } from "./appearance";
import { readInk, watchTheme } from "../drawing/ink";
import { placeCut } from "./cut";
import { graphOf } from "./graph";
import { usePointing } from "./pointing";
import { settingsOf } from "./settings";
import type { Stage } from "./stage";

/** Follows until the returned function is called. */
export function follow(stage: Stage): () => void {
  const repaint = (): void => paint(stage);
  const shown = (scene: Scene | null): void => {
    stage.show(scene);
    stage.change((contents) => contents.preview(usePreview.getState().preview));
    repaint();
    fetchBeside(stage, scene);
  };
  const stops = [
    useScenes.subscribe((now, before) => {
      if (now.scene === before.scene) return;
      if (now.scene) forgetGone(now.scene);
      shown(now.scene);
    }),
    useDesk.subscribe((now, before) => {
      if (now.view !== before.view) stage.set(settingsOf(now.view));
      if (now.view.compare !== before.view.compare || now.view.ghost !== before.view.ghost) {
        fetchBeside(stage, useScenes.getState().scene);
      }
      if (now.cameraOrder !== before.cameraOrder) obey(stage, now);
      if (LOOKS.some((key) => now[key] !== before[key])) repaint();
    }),
    usePreview.subscribe(({ preview }) => {
      stage.change((contents) => contents.preview(preview));
      repaint();
    }),
    useProject.subscribe((now, before) => {
      if (now.project.vocabulary !== before.project.vocabulary) repaint();
    }),
    usePointing.subscribe((now, before) => {
      if (now.region !== before.region) repaint();
    }),
    watchRelabelled(repaint),
    useCutting.subscribe(() => placeCut(stage)),
    watchTheme(() => {
      stage.change((contents) => contents.setInk(readInk()));
      repaint();
    }),
  ];
  shown(useScenes.getState().scene);
  return () => stops.forEach((stop) => stop());
}

const LOOKS = ["selection", "hover", "hidden", "highlight", "view", "tool", "stage"] as const;

function paint(stage: Stage): void {
  const { shown } = stage;
  if (!shown) return;
  const looks = appearances(shown.scene, stage.contents.ink);
  stage.change((contents) => contents.paint(looks.shown, looks.before));
  placeCut(stage);
  if (!stage.settings.contacts) return;
  const { nodes, lines, gaps } = graphOf(shown, stage.settings.explode);
  stage.gaps = gaps;
  stage.change(({ graph }) => graph.set(nodes, lines));
}

function obey(stage: Stage, { asset, cameraOrder, selection }: DeskState): void {
  const now = performance.now() / 1000;
  if (cameraOrder.to === "fit") stage.frame(null, now);
  else if (cameraOrder.to === "frame") stage.frame(selection, now);
  else if (cameraOrder.to === "near") stage.lookAt(asset ?? "", selection);
  else stage.view.lookFrom(cameraOrder.to, now);
  stage.invalidate();
}

/** Fetches what goes with a scene: the asset as it comes to compare with, and the visual mesh. */
function fetchBeside(stage: Stage, scene: Scene | null): void {
  const { compare, ghost } = useDesk.getState().view;
  const isStill = (): boolean => useScenes.getState().scene === scene;
  if (scene?.edit && compare !== "off") {
    const arrived = (before: Scene): void => {
      if (!isStill()) return;
      stage.change((contents) => contents.compareWith(before));
      paint(stage);
    };
    sceneOf(scene.asset, { kind: "source" }).then(arrived).catch(complainedOf);
  } else stage.change((contents) => contents.compareWith(null));
  if (scene?.view.has_visual && ghost && !stage.contents.ghost) {
    api.visual(scene.asset).then((packet) => isStill() && stage.change((contents) => contents.setGhost(packet))).catch(complainedOf);
  }
}
