// Keeps the stage in step with the stores and the theme, from when it is shown in an element of the page.
import type { WebGLRenderer } from "three";
import { readThemeColors } from "../drawing/themeColors";
import { watchTheme } from "../../pictures/cssColor";
import { api } from "../../server/api";
import { followBrush, useAlike } from "../../store/alike";
import { hullToCut, planeOf, useCut } from "../../store/cut";
import { usePreview } from "../../store/preview";
import { useProject } from "../../store/project";
import { type Scene, sceneOf, useScenes } from "../../store/scenes";
import { sectionPlane, useSection } from "../../store/section";
import { forgetMissing } from "../../store/selection";
import { useTour } from "../../store/tour";
import { useWorkspace, type WorkspaceState } from "../../store/workspace";
import { appearances, graphOf, showsPreview } from "./looks";
import { coversOf } from "./covers";
import { settingsOf } from "./panes";
import { useRegion } from "./regionStore";
import type { Stage } from "./stage";

/** Follows until the returned function is called. */
function followStores(stage: Stage): () => void {
  const repaint = (): void => paint(stage);
  const shown = (scene: Scene | null): void => {
    stage.show(scene);
    stage.change((contents) => contents.preview(usePreview.getState().preview));
    repaint();
    updateSection(stage);
    fetchBeside(stage, scene);
  };
  const stops = [
    useScenes.subscribe((now, before) => {
      if (now.scene === before.scene) return;
      if (now.scene) forgetMissing(now.scene);
      shown(now.scene);
    }),
    useWorkspace.subscribe((now, before) => {
      if (now.view !== before.view) stage.set(settingsOf(now.view));
      if (now.view.explode !== before.view.explode) updateSection(stage);
      if (now.view.compare !== before.view.compare || now.view.ghost !== before.view.ghost) {
        fetchBeside(stage, useScenes.getState().scene);
      }
      if (now.cameraOrder !== before.cameraOrder) moveCameraTo(stage, now);
      if (LOOKS.some((key) => now[key] !== before[key])) repaint();
    }),
    usePreview.subscribe(({ preview }) => {
      stage.change((contents) => contents.preview(preview));
      repaint();
    }),
    useProject.subscribe((now, before) => {
      if (now.project.vocabulary === before.project.vocabulary) return;
      repaint();
    }),
    useRegion.subscribe((now, before) => {
      if (now.region !== before.region) repaint();
    }),
    useAlike.subscribe(repaint),
    followBrush(),
    useCut.subscribe(() => updateCutPlane(stage)),
    fitBesideTour(stage),
    useSection.subscribe(() => updateSection(stage)),
    watchTheme(() => {
      stage.change((contents) => contents.setInk(readThemeColors()));
      repaint();
    }),
  ];
  shown(useScenes.getState().scene);
  return () => stops.forEach((stop) => stop());
}

/** [ms] until the card of the tour is in its place. */
const SETTLED = 300;

/** Moves what is shown as a whole out from under the card of the tour. */
function fitBesideTour(stage: Stage): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const fit = (): void => {
    if (stage.view.fitsAll) stage.frame(null, performance.now() / 1000);
  };
  const stop = useTour.subscribe((now, before) => {
    if (now.step === before.step) return;
    clearTimeout(timer);
    timer = setTimeout(fit, SETTLED);
  });
  return () => {
    stop();
    clearTimeout(timer);
  };
}

const LOOKS = ["selection", "hover", "hidden", "highlight", "view", "tool", "stage", "brush"] as const;

function paint(stage: Stage): void {
  const { shown } = stage;
  if (!shown) return;
  const looks = appearances(shown.scene, stage.contents.ink);
  stage.change((contents) => contents.paint(looks.shown, looks.before));
  updateCutPlane(stage);
  if (!stage.settings.contacts) return;
  const { nodes, lines, gaps } = graphOf(shown, stage.settings.explode);
  stage.gaps = gaps;
  stage.change(({ graph }) => graph.set(nodes, lines));
}

function moveCameraTo(stage: Stage, { asset, cameraOrder, selection }: WorkspaceState): void {
  const now = performance.now() / 1000;
  if (cameraOrder.to === "fit") stage.frame(null, now);
  else if (cameraOrder.to === "frame") stage.frame(selection, now);
  else if (cameraOrder.to === "near") stage.lookAt(asset ?? "", selection);
  else stage.view.lookFrom(cameraOrder.to, now);
  stage.invalidate();
}

/** Fetches what goes with a scene: the original asset to compare with, and the visual mesh. */
function fetchBeside(stage: Stage, scene: Scene | null): void {
  const { compare, ghost } = useWorkspace.getState().view;
  const isStill = (): boolean => useScenes.getState().scene === scene;
  if (scene?.edit && compare !== "off") {
    const arrived = (before: Scene): void => {
      if (!isStill()) return;
      stage.change((contents) => contents.compareWith(before));
      paint(stage);
    };
    void sceneOf(scene.asset, { kind: "source" }).then(arrived);
  } else stage.change((contents) => contents.compareWith(null));
  if (scene?.view.has_visual && ghost && !stage.contents.ghost) {
    void api.visual(scene.asset).then((packet) => isStill() && stage.change((contents) => contents.setGhost(packet)));
  }
}

const updateSection = (stage: Stage): void => stage.cutOpen(sectionPlane(stage.extent, useSection.getState()));

/** Shows the cutting plane where the tool is in hand and a hull is chosen. */
function updateCutPlane(stage: Stage): void {
  const { tool, selection } = useWorkspace.getState();
  const side = stage.shown;
  const hull = tool === "cut" && side ? hullToCut(side.scene, selection) : null;
  const plane = side && hull ? planeOf(side.scene, hull, useCut.getState()) : null;
  const away = side?.hulls.aways[side.hulls.places.get(hull?.name ?? "") ?? -1] ?? [0, 0, 0];
  stage.change(({ made, cut }) => {
    if (made) made.object.visible = showsPreview(tool);
    cut.set(plane, hull?.shape ?? null, away.map((value) => value * stage.settings.explode));
  });
}

/** Shows it until the returned function is called. */
export function mountStage(stage: Stage, gl: WebGLRenderer, holder: HTMLElement): () => void {
  let frame = 0;
  const draw = (): void => {
    frame = 0;
    if (stage.width > 0 && stage.height > 0) stage.draw(gl, performance.now() / 1000);
  };
  stage.invalidate = () => {
    frame ||= requestAnimationFrame(draw);
  };
  stage.covers = () => coversOf(holder);
  const resize = (): void => {
    stage.resize(holder.clientWidth, holder.clientHeight, Math.min(2, Math.max(1, window.devicePixelRatio)));
    // at once: the browser would stretch what is there
    cancelAnimationFrame(frame);
    draw();
  };
  const sizes = new ResizeObserver(resize);
  holder.append(gl.domElement);
  sizes.observe(holder);
  const stop = followStores(stage);
  return () => {
    stop();
    sizes.disconnect();
    cancelAnimationFrame(frame);
    stage.invalidate = () => undefined;
    stage.covers = () => [];
    stage.dispose();
    gl.domElement.remove();
  };
}
