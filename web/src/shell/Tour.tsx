// Coach marks beside the real places; they go on by what the person does.
import { useEffect, useState } from "react";
import { useProject } from "../store/project";
import { endTour, followTour, moveTour, startTour, TOUR_STOPS, useTour } from "../store/tour";
import css from "./tour.module.css";
import { Button } from "../ui/Button";

const KEY = "meshforge.tour";

export function Tour() {
  const wanted = useProject((state) => state.tour);
  const step = useTour((tour) => tour.step);
  useEffect(() => {
    if (wanted && localStorage.getItem(KEY) !== "done") startTour();
  }, [wanted]);
  useEffect(followTour, []);
  useEffect(() => useTour.subscribe((now, before) => now.step === null && before.step !== null && rememberEnd()), []);
  return step === null ? null : <StopCard step={step} />;
}

const rememberEnd = () => localStorage.setItem(KEY, "done");

function StopCard({ step }: { step: number }) {
  const mark = TOUR_STOPS[step];
  const text = useProject((state) => (typeof mark?.text === "function" ? mark.text(state) : mark?.text));
  const target = usePlace(mark?.at ?? "view");
  if (!mark) return null;
  const last = step === TOUR_STOPS.length - 1;
  return (
    <>
      {target && <div className={css.ring} style={ringStyle(target)} aria-hidden />}
      <div className={css.mark} style={cardStyle(target, mark.at)} role="dialog" data-modeless data-part aria-label={`Tour: ${mark.title}`}>
        <h2>{mark.title}</h2>
        <p aria-live="polite">{text}</p>
        <footer>
          <span className={css.count}>
            {step + 1} of {TOUR_STOPS.length}
          </span>
          {!last && (
            <Button look="quiet" onClick={endTour}>
              Skip the tour
            </Button>
          )}
          {step > 0 && (
            <Button look="quiet" onClick={() => moveTour(-1)}>
              Back
            </Button>
          )}
          <Button look={mark.done ? "plain" : "primary"} onClick={() => moveTour(1)}>
            {last ? "Done" : "Next"}
          </Button>
        </footer>
      </div>
    </>
  );
}

/** Where a part of the window is, also after it moved. */
function usePlace(at: string): DOMRect | null {
  const [place, setPlace] = useState<DOMRect | null>(null);
  useEffect(() => {
    const look = () => {
      const now = document.querySelector(`[data-tour="${at}"]`)?.getBoundingClientRect() ?? null;
      setPlace((before) => (before && now && isSame(before, now) ? before : now));
    };
    look();
    const timer = setInterval(look, 200);
    return () => clearInterval(timer);
  }, [at]);
  return place;
}

const isSame = (a: DOMRect, b: DOMRect) => a.x === b.x && a.y === b.y && a.width === b.width && a.height === b.height;

const ringStyle = (place: DOMRect) => ({ left: place.x, top: place.y, width: place.width, height: place.height });

const WIDTH = 320;
const AWAY = 14;

/** Beside its place, on whichever side there is room; in a corner of it where it is the view itself. */
function cardStyle(place: DOMRect | null, at: string): React.CSSProperties {
  if (!place) return { left: AWAY, bottom: AWAY, width: WIDTH };
  const { innerWidth: across, innerHeight: down } = window;
  if (at === "view") return { right: across - place.right + AWAY, bottom: down - place.bottom + AWAY, width: WIDTH };
  if (at === "steps") return { left: place.left + AWAY, bottom: down - place.top + AWAY, width: WIDTH };
  // above the steps, where the controls of the view are not
  if (at === "panel" && place.left >= WIDTH + 2 * AWAY) {
    return { right: across - place.left + AWAY, bottom: 46 + AWAY, width: WIDTH };
  }
  const top = Math.min(Math.max(place.y + 12, 8), down - 220);
  if (place.left >= WIDTH + 2 * AWAY) return { right: across - place.left + AWAY, top, width: WIDTH };
  if (across - place.right >= WIDTH + 2 * AWAY) return { left: place.right + AWAY, top, width: WIDTH };
  return { left: place.left + AWAY, bottom: down - place.bottom + AWAY, width: WIDTH };
}
