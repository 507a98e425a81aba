// A line between two parts that can be moved, by pointer or arrow keys.
import { type CSSProperties, type KeyboardEvent, type PointerEvent, useRef, useState } from "react";
import css from "./divider.module.css";

interface DividerProps {
  name: string;
  along: "x" | "y";
  /** At which side of the part it lies, over it; else it has a place between two parts. */
  edge?: "left" | "right";
  value: number;
  range: readonly [number, number];
  /** Of a line with looks of its own. */
  className?: string | undefined;
  style?: CSSProperties;
  /** The part that is measured lies after the line. */
  flipped?: boolean;
  /** How many units of the value a pixel is; 1 unless it is a share. */
  unit?: () => number;
  onChange: (value: number) => void;
  /** What dragging it far below the least does. */
  onCollapse?: () => void;
}

export function Divider({ name, along, edge, className = css.divider, style, value, range, flipped, unit, onChange, onCollapse }: DividerProps) {
  const from = useRef<{ at: number; value: number } | null>(null);
  const [dragged, setDragged] = useState(false);
  const [least, most] = range;
  const place = (event: PointerEvent) => (along === "x" ? event.clientX : event.clientY);
  const put = (wanted: number) => onChange(Math.min(Math.max(wanted, least), most));
  const pixel = () => (unit?.() ?? 1) * (flipped ? -1 : 1);

  function move(event: PointerEvent): void {
    if (!from.current) return;
    const wanted = from.current.value + (place(event) - from.current.at) * pixel();
    if (onCollapse && wanted < least / 2) {
      from.current = null;
      setDragged(false);
      return onCollapse();
    }
    put(wanted);
  }
  function key(event: KeyboardEvent): void {
    const by = { ArrowLeft: -16, ArrowUp: -16, ArrowRight: 16, ArrowDown: 16, PageUp: -80, PageDown: 80 }[event.key];
    const end = { Home: least, End: most }[event.key];
    if (by === undefined && end === undefined) return;
    event.preventDefault();
    put(end ?? value + (by ?? 0) * pixel());
  }
  return (
    <div
      role="separator"
      tabIndex={0}
      aria-label={name}
      aria-orientation={along === "x" ? "vertical" : "horizontal"}
      aria-valuenow={Math.round(value * 100) / 100}
      aria-valuemin={least}
      aria-valuemax={most}
      className={className}
      style={style}
      data-along={along}
      data-edge={edge}
      data-dragged={dragged}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        from.current = { at: place(event), value };
        setDragged(true);
      }}
      onPointerMove={move}
      onPointerUp={() => {
        from.current = null;
        setDragged(false);
      }}
      onKeyDown={key}
    />
  );
}
