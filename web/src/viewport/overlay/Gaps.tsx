// How far hulls that nearly touch are apart, written where the selected or pointed one has such neighbours.
import { useRef } from "react";
import { useDesk } from "../../store/desk";
import { type Gap, graphOf } from "../stage/graph";
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
    const { shown, settings } = stage;
    const pane = stage.panes().at(-1);
    const gaps = shown ? graphOf(shown, settings.explode).gaps : [];
    holder.current?.replaceChildren(
      ...gaps.map(({ at, gap }) => labelled(gap, pane ? stage.pixelOf(at, pane) : { x: 0, y: 0 })),
    );
  });
  return <div ref={holder} className={css.gaps} aria-hidden />;
}

function labelled(gap: Gap["gap"], { x, y }: { x: number; y: number }): HTMLElement {
  const label = document.createElement("span");
  label.textContent = `${Number((1000 * gap).toPrecision(2))} mm`;
  label.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px) translate(-50%, -50%)`;
  return label;
}
