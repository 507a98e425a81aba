// A picture of hulls in colours that the page chooses.
import { useEffect, useMemo, useRef, useState, useSyncExternalStore } from "react";
import { useProject } from "../store/project";
import { toRgb, watchTheme } from "./cssColor";
import { drawOn, drawSoon } from "./drawQueue";
import { type IdMap, type Paint, paintPixels } from "./idMap";
import { decodePicture, findPicture, requestPicture } from "./pictureCache";
import css from "./pictures.module.css";

type IdPictureProps = Source & {
  /** What a screen reader says; empty where words beside it say the same. */
  label?: string;
  /** The colour of the hull in a place, in CSS; -1 stands for geometry that is no hull. */
  colors: (position: number) => string;
  fill?: Paint["fill"];
  /** In CSS pixels; the picture fills its place without it. */
  width?: number;
  className?: string;
};

export function IdPicture({ label, colors, fill, width, className, ...source }: IdPictureProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { map, current, failed } = useIdMap(source.png ? { png: source.png } : { url: source.url ?? "" });
  const [drawn, setDrawn] = useState(false);
  const look = useTheme();
  const paint = useMemo(() => ({ color: (k: number) => toRgb(colors(k)), fill }), [colors, fill]);
  useEffect(() => {
    const element = canvas.current;
    // what was painted before stays until the next picture is there: its hulls are others
    if (!map || !current || !element) return;
    return drawSoon(element, () => {
      drawOn(element, new ImageData(paintPixels(map, paint), map.width, map.height));
      setDrawn(true);
    });
  }, [map, current, paint, look]);
  const text = label ?? "Picture of an asset";
  return (
    <div
      className={[css.picture, className].filter(Boolean).join(" ")}
      style={width === undefined ? undefined : { width }}
      role={text ? "img" : undefined}
      aria-label={text || undefined}
      aria-hidden={text ? undefined : true}
      data-state={drawn ? "there" : failed ? "failed" : "coming"}
    >
      <canvas ref={canvas} aria-hidden />
      {failed && !map && <span className={css.missing}>No picture</span>}
    </div>
  );
}

type Source = { url: string; png?: undefined } | { url?: undefined; png: Blob };

interface Had {
  map: IdMap | null;
  /** What the map is of. */
  of: string | Blob | undefined;
}

/** failed: it could not be had. current: whether the map is of what is asked for, not of what was before. */
function useIdMap({ url, png }: Source): { map: IdMap | null; current: boolean; failed: boolean } {
  const [{ map, of }, setMap] = useState<Had>(() => ({ map: url === undefined ? null : findPicture(url), of: url }));
  const [failed, setFailed] = useState(false);
  const health = useProject((state) => `${state.connected} ${state.project.problem}`);
  useEffect(() => {
    const there = url === undefined ? null : findPicture(url);
    if (there) {
      setMap((had) => (had.map === there && had.of === url ? had : { map: there, of: url }));
      return setFailed(false);
    }
    let mounted = true;
    let drop: (() => void) | undefined;
    const good = (value: IdMap) => {
      if (!mounted) return;
      setMap({ map: value, of: png ?? url });
      setFailed(false);
    };
    const bad = () => mounted && setFailed(true);
    const ask = () => {
      if (png) return void decodePicture(png).then(good, bad);
      const asked = requestPicture(url);
      drop = asked.drop;
      asked.result.then(good, bad);
    };
    // a card that is only scrolled past asks for nothing
    const timer = setTimeout(ask, png ? 0 : 50);
    return () => {
      mounted = false;
      clearTimeout(timer);
      drop?.();
    };
  }, [url, png, health]);
  return { map, current: of === (png ?? url), failed };
}

/** The look that the page has now, so that what is drawn by hand is drawn again when it changes. */
const useTheme = (): string =>
  useSyncExternalStore(watchTheme, () => document.documentElement.dataset.theme ?? "light");
