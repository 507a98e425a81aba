// The canvas: three.js draws the stage on it when something changed, the pointer acts on it.
import { Canvas, useFrame, useThree } from "@react-three/fiber";
import { useEffect, useRef, useState } from "react";
import { setTool, useDesk } from "../store/desk";
import { useScenes } from "../store/scenes";
import { Gestures } from "./pointer/gestures";
import { gripOf } from "./pointer/grips";
import { useStage } from "./stage/context";
import { follow } from "./stage/following";
import css from "./viewport.module.css";

/** smooth: whether edges are to be smoothed, which costs too much where the processor draws. */
export function Picture({ smooth }: { smooth: boolean }) {
  const stage = useStage();
  const [gl] = useState(() => ({ alpha: true, antialias: smooth, powerPreference: "high-performance" as const }));
  const holder = useRef<HTMLDivElement>(null);
  useEffect(() => {
    if (!holder.current) return;
    return new Gestures(holder.current, stage, gripOf(stage)).listen();
  }, [stage]);
  useEffect(leavingByEscape, []);
  const cursor = useDesk(({ tool, brush }) => (tool === "select" ? (brush === null ? "select" : "brush") : tool));
  const name = useScenes(({ scene }) => (scene ? `${scene.asset}, ${scene.hulls.length} hulls` : "nothing"));
  return (
    <div ref={holder} className={css.picture} data-tool={cursor} role="img" aria-label={`View of ${name}`}>
      <Canvas frameloop="demand" flat dpr={[1, 2]} gl={gl} resize={{ debounce: 0 }}>
        <Drawing />
      </Canvas>
    </div>
  );
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

/** Hands the frames and the size of the canvas to the stage. */
function Drawing() {
  const stage = useStage();
  const invalidate = useThree((state) => state.invalidate);
  const size = useThree((state) => state.size);
  const pixel = useThree((state) => state.viewport.dpr);
  useEffect(() => {
    stage.invalidate = invalidate;
    const stop = follow(stage);
    return () => {
      stop();
      stage.invalidate = () => undefined;
      stage.dispose();
    };
  }, [stage, invalidate]);
  useEffect(() => stage.resize(size.width, size.height, pixel), [stage, size.width, size.height, pixel]);
  // a priority above 0 leaves drawing to this callback
  useFrame(({ gl }) => stage.draw(gl, performance.now() / 1000), 1);
  return null;
}
