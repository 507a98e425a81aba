// How far hulls that nearly touch are apart, written where the selected or pointed one has such neighbours.
import { useRef } from "react";
import { useDesk } from "../../store/desk";
import type { Gap } from "../stage/graph";
import { useDrawn, useStage } from "../stage/context";
import css from "./overlay.module.css";

export function Gaps() {
  const contacts = useDesk((desk) => desk.view.contacts);
  return contacts ? <GapLabels /> : null;
}

function GapLabels() {
  const stage = useStage();
  const holder = useRef<HTMLDivElement>(null);
  useDrawn(() => {
    const pane = stage.panes().at(-1);
    if (!pane) return;
    const spots = apart(stage.gaps.map(({ at }) => stage.pixelOf(at, pane)));
    holder.current?.replaceChildren(...stage.gaps.flatMap(({ gap }, k) => (spots[k] ? [labelled(gap, spots[k])] : [])));
  });
  return <div ref={holder} className={css.gaps} aria-hidden />;
}

interface Spot {
  readonly x: number;
  readonly y: number;
}

const [WIDE, HIGH] = [58, 19];

/** Spots of which none covers one before it; those that would are moved down. */
function apart(spots: readonly Spot[]): Spot[] {
  const out: Spot[] = [];
  for (const { x, y } of spots) {
    let free = y;
    const covers = (other: Spot) => Math.abs(other.x - x) < WIDE && Math.abs(other.y - free) < HIGH;
    for (let at = out.find(covers); at; at = out.find(covers)) free = at.y + HIGH;
    out.push({ x, y: free });
  }
  return out;
}

function labelled(gap: Gap["gap"], { x, y }: Spot): HTMLElement {
  const label = document.createElement("span");
  label.textContent = `${Number((1000 * gap).toPrecision(2))} mm`;
  label.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px) translate(-50%, -50%)`;
  return label;
}
