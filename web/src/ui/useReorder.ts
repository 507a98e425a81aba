// Lines of a list that are dragged to another place.
import { type DragEvent, useState } from "react";

interface Hover {
  from: number;
  /** The gap above which a line would land: 0 before the first. */
  gap: number;
}

/** Properties for each line of a list along an axis; `move` gets the old and the new place. */
export function useReorder(axis: "x" | "y", move: (from: number, to: number) => void) {
  const [hover, setHover] = useState<Hover | null>(null);
  const over = (event: DragEvent, place: number) => {
    if (!hover) return;
    event.preventDefault();
    const box = event.currentTarget.getBoundingClientRect();
    const share = axis === "y" ? (event.clientY - box.top) / box.height : (event.clientX - box.left) / box.width;
    const gap = place + (share > 0.5 ? 1 : 0);
    if (gap !== hover.gap) setHover({ ...hover, gap });
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setHover(null);
    if (!hover) return;
    const to = hover.gap > hover.from ? hover.gap - 1 : hover.gap;
    if (to !== hover.from) move(hover.from, to);
  };
  return (place: number, last: boolean) => ({
    draggable: true,
    onDragStart: (event: DragEvent) => {
      event.dataTransfer.effectAllowed = "move";
      event.dataTransfer.setData("text/plain", "");
      setHover({ from: place, gap: place });
    },
    onDragOver: (event: DragEvent) => over(event, place),
    onDrop: drop,
    onDragEnd: () => setHover(null),
    "data-drop": hover?.gap === place ? "before" : last && hover?.gap === place + 1 ? "after" : undefined,
  });
}
