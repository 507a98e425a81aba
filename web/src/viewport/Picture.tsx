// The canvas: three.js draws the stage on it when something changed, the pointer acts on it.
import { useEffect, useRef } from "react";
import type { WebGLRenderer } from "three";
import { setTool, useDesk } from "../store/desk";
import { useScenes } from "../store/scenes";
import { Gestures } from "./pointer/gestures";
import { gripOf } from "./pointer/grips";
import { useStage } from "./stage/context";
import { show } from "./stage/showing";
import css from "./viewport.module.css";

export function Picture({ gl }: { gl: WebGLRenderer }) {
  const stage = useStage();
  const holder = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!holder.current) return;
    return new Gestures(holder.current, stage, gripOf(stage)).listen();
  }, [stage]);
  useEffect(() => (holder.current ? show(stage, gl, holder.current) : undefined), [stage, gl]);
  useEffect(leavingByEscape, []);
  const cursor = useDesk(({ tool, brush }) => (tool === "select" ? (brush === null ? "select" : "brush") : tool));
  const name = useScenes(({ scene }) => (scene ? `${scene.asset}, ${scene.hulls.length} hulls` : "nothing"));
  return <div ref={holder} className={css.picture} data-tool={cursor} role="img" aria-label={`View of ${name}`} />;
}

/** Escape puts a tool down before it means anything else; the cutting tool sees to it itself. */
function leavingByEscape(): () => void {
  const press = (event: KeyboardEvent) => {
    const { tool } = useDesk.getState();
    if (event.key !== "Escape" || event.defaultPrevented || tool === "select" || tool === "cut") return;
    event.preventDefault();
    setTool("select");
  };
  window.addEventListener("keydown", press, true);
  return () => window.removeEventListener("keydown", press, true);
}
