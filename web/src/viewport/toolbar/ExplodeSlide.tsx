// How far hulls are moved apart; a double click puts them together again.
import { Expand } from "lucide-react";
import { setView, useDesk } from "../../store/desk";
import { Slide } from "../../ui/Slide";
import { Tip } from "../../ui/Tip";
import css from "./toolbar.module.css";

export function ExplodeSlide() {
  const explode = useDesk((desk) => desk.view.explode);
  return (
    <Tip text="Exploded view; a double click puts the hulls together again">
      <span className={css.explode} onDoubleClick={() => setView({ explode: 0 })}>
        <Expand size={15} aria-hidden />
        <Slide name="Exploded view" value={explode} onChange={(value) => setView({ explode: value })} />
      </span>
    </Tip>
  );
}
