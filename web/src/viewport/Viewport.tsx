// The view of an asset: a toolbar, the picture, and what lies over it.
import { useEffect, useRef, useState } from "react";
import type { WebGLRenderer } from "three";
import { useScenes } from "../store/scenes";
import { useSection } from "../store/section";
import { countText } from "../store/words";
import { setTool, useWorkspace } from "../store/workspace";
import { type Canvas, getCanvas } from "./canvas";
import { CutBar } from "./overlay/CutBar";
import { CompareLine } from "./overlay/CompareLine";
import { HiddenChip } from "./overlay/HiddenChip";
import { InfoLines, Legend } from "./overlay/InfoLines";
import { DrawnRegion, Gaps, LandmarkBar, LandmarkMarks } from "./overlay/Marks";
import { Messages, NoWebGl } from "./overlay/Messages";
import { BrushFrame, SelectionBar } from "./overlay/SelectionBar";
import { SheetNames } from "./overlay/SheetNames";
import { RulerBar, RulerMarks } from "./overlay/Ruler";
import { SectionBar, SectionHandle } from "./overlay/SectionBar";
import { Triad } from "./overlay/Triad";
import { ViewCube } from "./overlay/ViewCube";
import { Gestures } from "./pointer/gestures";
import { watchHeldKeys } from "./pointer/heldKeys";
import { createPointerTool } from "./pointer/tools";
import { StageContext, useStage } from "./stage/context";
import { settingsOf } from "./stage/panes";
import { exposeProbe } from "./stage/picking";
import { Stage } from "./stage/stage";
import { mountStage } from "./stage/sync";
import { Toolbar } from "./toolbar/Toolbar";
import css from "./viewport.module.css";

export function Viewport() {
  const [sheet] = useState(getCanvas);
  const [stage] = useState(() => new Stage(settingsOf(useWorkspace.getState().view), sheet?.smooth ?? true));
  const root = useRef<HTMLElement>(null);
  const asset = useScenes(({ scene }) => scene?.asset ?? "");
  const loading = useScenes((state) => state.loading);
  useEffect(() => (root.current ? exposeProbe(stage, root.current) : undefined), [stage]);
  return (
    <StageContext.Provider value={stage}>
      <section ref={root} className={css.viewport} data-testid="viewport" data-asset={asset} aria-label="View" aria-busy={loading}>
        <Toolbar />
        <div className={css.stage}>
          {sheet ? <CanvasLayers sheet={sheet} /> : <NoWebGl />}
          <Messages />
        </div>
      </section>
    </StageContext.Provider>
  );
}

function CanvasLayers({ sheet }: { sheet: Canvas }) {
  const tool = useWorkspace((workspace) => workspace.tool);
  const contacts = useWorkspace((workspace) => workspace.view.contacts);
  const isCutOpen = useSection((section) => section.on);
  const parts = useScenes(({ scene }) => scene?.parts);
  return (
    <>
      <CanvasView gl={sheet.gl} />
      <DrawnRegion />
      <CompareLine />
      {contacts && <Gaps />}
      <LandmarkMarks />
      <RulerMarks />
      {isCutOpen && <SectionHandle />}
      <ViewCube />
      <Triad />
      <InfoLines />
      <Legend />
      {parts && <SheetNames parts={parts} />}
      <BrushFrame />
      <div className={css.top}>
        <HiddenChip />
        {isCutOpen && <SectionBar />}
        {tool === "ruler" && <RulerBar />}
        {tool === "cut" && <CutBar />}
        {tool === "landmark" && <LandmarkBar />}
        <SelectionBar />
      </div>
    </>
  );
}

/** The canvas: three.js draws the stage on it when something changed, the pointer acts on it. */
function CanvasView({ gl }: { gl: WebGLRenderer }) {
  const stage = useStage();
  const holder = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!holder.current) return;
    return new Gestures(holder.current, stage, createPointerTool(stage)).listen();
  }, [stage]);
  useEffect(() => (holder.current ? mountStage(stage, gl, holder.current) : undefined), [stage, gl]);
  useEffect(leaveToolByEscape, []);
  useEffect(watchHeldKeys, []);
  const cursor = useWorkspace(({ tool, brush }) => (tool === "select" ? (brush === null ? "select" : "brush") : tool));
  const name = useScenes(({ scene }) => (scene ? `${scene.parts ? countText(scene.parts.length, "asset") : scene.asset}, ${scene.hulls.length} hulls` : "nothing"));
  return <div ref={holder} className={css.picture} data-tool={cursor} role="img" aria-label={`View of ${name}`} />;
}

/** Escape puts a tool down before it means anything else; the cutting tool sees to it itself. */
function leaveToolByEscape(): () => void {
  const press = (event: KeyboardEvent) => {
    const { tool } = useWorkspace.getState();
    if (event.key !== "Escape" || event.defaultPrevented || tool === "select" || tool === "cut") return;
    event.preventDefault();
    setTool("select");
  };
  window.addEventListener("keydown", press, true);
  return () => window.removeEventListener("keydown", press, true);
}
