// The section plane over the view: along which axis, where, which side, and an arrow on the plane to drag it.
import { FlipHorizontal2, X } from "lucide-react";
import { type PointerEvent, useRef } from "react";
import { Vector3 } from "three";
import { useScenes } from "../../store/scenes";
import { type SectionAxis, sectionAlong, sectionFacing, setSection, useSection } from "../../store/section";
import { ACROSS, midpoint, plus, type Vec } from "../../store/vectors";
import { IconButton } from "../../ui/Button";
import { Choice, Slide } from "../../ui/fields";
import { axesOf } from "../camera/pose";
import { frameCorners } from "../drawing/section";
import { useFrame, useStage } from "../stage/context";
import type { Stage } from "../stage/stage";
import css from "./overlay.module.css";
import tools from "./tools.module.css";

const AXES: readonly { value: SectionAxis; label: string; name: string }[] = [
  ...ACROSS,
  { value: "view", label: "View", name: "Across the direction of the view as it is now" },
];

export function SectionBar() {
  const { axis, share, flipped } = useSection();
  const there = useScenes(({ scene }) => scene !== null);
  const stage = useStage();
  if (!there) return null;
  const put = (next: SectionAxis) => (next === "view" ? sectionFacing([...axesOf(stage.view.pose).eye]) : sectionAlong(next, useScenes.getState().scene?.view.y_up));
  return (
    <div className={css.bar} role="group" aria-label="Section plane" data-testid="section">
      <span>Section</span>
      <Choice name="Direction of the section plane" value={axis} options={AXES} onChange={put} />
      <Slide name="Place of the section plane" value={share} step={0.005} onChange={(next) => setSection({ share: next })} />
      <IconButton icon={FlipHorizontal2} name="Flip: show the other side" on={flipped} onClick={() => setSection({ flipped: !flipped })} />
      <IconButton icon={X} name="Close the section" keys="Shift+K" onClick={() => setSection({ on: false })} />
    </div>
  );
}

/** An arrow on the plane that slides it; keys have the slider of the bar. */
export function SectionHandle() {
  const stage = useStage();
  const handle = useRef<HTMLDivElement>(null);
  const grip = useRef<{ x: number; y: number; share: number } | null>(null);
  useFrame(() => {
    const line = lineOf(stage);
    if (!handle.current) return;
    handle.current.style.visibility = line ? "visible" : "hidden";
    if (line) handle.current.style.transform = `translate(${line.x}px, ${line.y}px) rotate(${Math.atan2(line.dy, line.dx)}rad)`;
  });
  const down = (event: PointerEvent<HTMLDivElement>) => {
    event.currentTarget.setPointerCapture(event.pointerId);
    grip.current = { x: event.clientX, y: event.clientY, share: useSection.getState().share };
  };
  const move = (event: PointerEvent<HTMLDivElement>) => {
    const line = lineOf(stage);
    if (!grip.current || !line) return;
    const along = (event.clientX - grip.current.x) * line.dx + (event.clientY - grip.current.y) * line.dy;
    setSection({ share: grip.current.share + along / (line.dx ** 2 + line.dy ** 2) });
  };
  const drop = () => (grip.current = null);
  return (
    <div
      ref={handle}
      className={tools.handle}
      aria-hidden
      title="Drag to move the section plane"
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={drop}
      onPointerCancel={drop}
    >
      <svg width="44" height="16" viewBox="-22 -8 44 16">
        <path d="M-21 0 -13 -7V-2.5H13V-7L21 0 13 7V2.5H-13V7Z" />
      </svg>
    </div>
  );
}

/** Where the handle is seen, at the highest side of the frame, and how far the plane goes on the screen from one end of the
 * asset to the other [px]. */
function lineOf(stage: Stage): { x: number; y: number; dx: number; dy: number } | null {
  const pane = stage.panes().at(-1);
  if (!stage.section || !pane) return null;
  const corners = frameCorners(stage.section, stage.extent);
  const middles = corners.map((corner, k) => midpoint(corner, corners[(k + 1) % corners.length] ?? corner));
  const pixel = (point: Vec) => stage.view.pixelOf(new Vector3(...point));
  const [first, ...others] = middles;
  if (!first) return null;
  const at = others.reduce((best, point) => (pixel(point).y < pixel(best).y ? point : best), first);
  const step = 0.1;
  const [a, b] = [pixel(at), pixel(plus(at, useSection.getState().across, step * stage.sectionSpan))];
  const [dx, dy] = [(b.x - a.x) / step, (b.y - a.y) / step];
  const inside = (value: number, size: number) => Math.min(Math.max(value, 24), size - 24);
  const spot = { x: inside(a.x, pane.width) + pane.x, y: inside(a.y, stage.height) };
  // seen from straight ahead the way is a point: there up is nearer
  return Math.hypot(dx, dy) < 24 ? { ...spot, dx: 0, dy: -stage.height / 2 } : { ...spot, dx, dy };
}
