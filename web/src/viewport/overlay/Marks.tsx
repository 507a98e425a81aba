// Marks over the picture: the region that is being drawn, how far hulls that nearly touch are apart, and clicked
// landmarks.
import { useRef } from "react";
import type { Gap } from "../drawing/contactGraph";
import { useFrame, useStage } from "../stage/context";
import { useRegion } from "../stage/regionStore";
import { lengthText } from "../../store/units";
import { setTool, useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import css from "./overlay.module.css";

export function DrawnRegion() {
  const drawn = useRegion((state) => state.drawn);
  const count = useRegion((state) => state.region.size);
  const last = drawn.at(-1);
  if (drawn.length < 2 || !last) return null;
  return (
    <svg className={css.drawn} aria-hidden>
      <polygon points={drawn.map((spot) => spot.join(",")).join(" ")} />
      {drawn.length > 2 && (
        <text x={(drawn.length === 4 ? drawn[2] : last)?.[0]} y={(drawn.length === 4 ? drawn[2] : last)?.[1]} dx={10} dy={4}>
          {count}
        </text>
      )}
    </svg>
  );
}

/** How far hulls that nearly touch are apart, written where the selected or pointed one has such neighbours. */
export function Gaps() {
  const stage = useStage();
  const holder = useRef<HTMLDivElement>(null);
  useFrame(() => {
    const pane = stage.panes().at(-1);
    if (!pane) return;
    const spots = separateSpots(stage.gaps.map(({ at }) => stage.pixelOf(at, pane)));
    holder.current?.replaceChildren(...stage.gaps.flatMap(({ gap }, k) => (spots[k] ? [gapLabel(gap, spots[k])] : [])));
  });
  return <div ref={holder} className={css.gaps} aria-hidden />;
}

interface Spot {
  readonly x: number;
  readonly y: number;
}

/** Spots of which none covers one before it; those that would are moved down. */
export function separateSpots(spots: readonly Spot[], wide = 58, high = 19): Spot[] {
  const out: Spot[] = [];
  for (const { x, y } of spots) {
    let free = y;
    const covers = (other: Spot) => Math.abs(other.x - x) < wide && Math.abs(other.y - free) < high;
    for (let at = out.find(covers); at; at = out.find(covers)) free = at.y + high;
    out.push({ x, y: free });
  }
  return out;
}

function gapLabel(gap: Gap["gap"], { x, y }: Spot): HTMLElement {
  const label = document.createElement("span");
  label.textContent = lengthText(gap, useWorkspace.getState().unit, 2);
  label.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px) translate(-50%, -50%)`;
  return label;
}

const NAMES = ["Start", "End"];

/** Marks on the hulls that were clicked for the orientation. */
export function LandmarkMarks() {
  const landmarks = useWorkspace((workspace) => workspace.landmarks);
  return landmarks.map((name, k) => <Mark key={name} hull={name} text={NAMES[k] ?? ""} />);
}

/** What to click for the orientation. */
export function LandmarkBar() {
  const landmarks = useWorkspace((workspace) => workspace.landmarks);
  return (
    <div className={css.bar} role="status">
      {landmarks.length === 1 ? "Now click the hull where the direction ends." : "Click the hull where the direction starts, such as a leg for up."}
      <Button look="quiet" onClick={() => setTool("select")} keys="Escape" tip="Leave">
        Leave
      </Button>
    </div>
  );
}

function Mark({ hull, text }: { hull: string; text: string }) {
  const stage = useStage();
  const mark = useRef<HTMLSpanElement>(null);
  useFrame(() => {
    const place = stage.shown?.hulls.places.get(hull);
    const pane = stage.panes().at(-1);
    if (!mark.current || !stage.shown || place === undefined || !pane) return;
    const { x, y } = stage.pixelOf(stage.shown.hulls.middle(place, stage.settings.explode), pane);
    mark.current.style.transform = `translate(${x}px, ${y}px) translate(-50%, -140%)`;
  });
  return (
    <span ref={mark} className={css.mark}>
      {text}
    </span>
  );
}
