// What the colours mean where that is not told elsewhere.
import { useDesk } from "../../store/desk";
import { useScenes } from "../../store/scenes";
import { Swatch } from "../../ui/Section";
import { CONFIDENCE, PALETTE } from "../colors/palette";
import css from "./overlay.module.css";

const MOST = 10;

export function Legend() {
  const colorBy = useDesk((desk) => desk.view.colorBy);
  const bodies = useScenes(({ scene }) => scene?.view.bodies);
  if (colorBy === "confidence") return <Scale />;
  if (colorBy !== "body" || !bodies) return null;
  return (
    <ul className={css.legend} aria-label="Colours of the bodies">
      {bodies.slice(0, MOST).map((body, k) => (
        <li key={body}>
          <Swatch color={PALETTE[k % PALETTE.length] ?? ""} /> {body}
        </li>
      ))}
      {bodies.length > MOST && <li>and {bodies.length - MOST} more</li>}
    </ul>
  );
}

function Scale() {
  return (
    <div className={css.legend} aria-label="Colours of confidence">
      <div className={css.scale} style={{ background: `linear-gradient(to right, ${CONFIDENCE.join(",")})` }} />
      <div className={css.scaleEnds}>
        <span>0 %</span>
        <span>unsure · sure</span>
        <span>100 %</span>
      </div>
      <span>
        <Swatch color="var(--hull-unlabelled)" /> no label
      </span>
    </div>
  );
}
