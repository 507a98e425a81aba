// The box, lasso or cutting line that is being drawn.
import { usePointing } from "../stage/pointing";
import css from "./overlay.module.css";

export function Drawn() {
  const drawn = usePointing((state) => state.drawn);
  const count = usePointing((state) => state.region.size);
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
