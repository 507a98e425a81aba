// The line between before and after, dragged by pointer or arrow keys, and the names of both sides.
import { type KeyboardEvent, type PointerEvent, useRef } from "react";
import { useScenes } from "../../store/scenes";
import { setView, useWorkspace } from "../../store/workspace";
import css from "./overlay.module.css";

const STEP = 0.02;

export function CompareLine() {
  const compare = useWorkspace((workspace) => workspace.view.compare);
  const both = useScenes(({ scene }) => scene?.edit != null);
  if (compare === "off" || !both) return null;
  return (
    <>
      {compare === "slider" ? <DividingLine /> : <div className={css.middle} />}
      <span className={css.sideName} style={{ left: 10 }} data-side>
        Before
      </span>
      <span className={css.sideName} style={{ left: compare === "side" ? "calc(50% + 10px)" : undefined, right: compare === "side" ? undefined : 110 }}>
        After
      </span>
    </>
  );
}

function DividingLine() {
  const divider = useWorkspace((workspace) => workspace.view.divider);
  const line = useRef<HTMLDivElement>(null);
  const set = (value: number) => setView({ divider: Math.min(0.98, Math.max(0.02, value)) });
  const drag = (event: PointerEvent<HTMLDivElement>) => {
    const whole = line.current?.parentElement?.getBoundingClientRect();
    if (whole && event.currentTarget.hasPointerCapture(event.pointerId)) set((event.clientX - whole.left) / whole.width);
  };
  const press = (event: KeyboardEvent) => {
    const by = { ArrowLeft: -STEP, ArrowRight: STEP, PageUp: -5 * STEP, PageDown: 5 * STEP }[event.key];
    const to = { Home: 0, End: 1 }[event.key];
    if (by === undefined && to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    set(to ?? divider + (by ?? 0));
  };
  return (
    <div
      ref={line}
      className={css.divider}
      style={{ left: `${100 * divider}%` }}
      role="separator"
      aria-orientation="vertical"
      aria-label="Line between before and after"
      aria-valuenow={Math.round(100 * divider)}
      aria-valuemin={0}
      aria-valuemax={100}
      tabIndex={0}
      onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
      onPointerMove={drag}
      onKeyDown={press}
    />
  );
}
