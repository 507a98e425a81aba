// A picture of hulls in colours that the page chooses.
import { useEffect, useMemo, useRef } from "react";
import { rgb } from "./colors";
import { painted } from "./idmap";
import css from "./pictures.module.css";
import { useIdMap, type Source } from "./useIdMap";
import { useLook } from "./useLook";

export type IdPictureProps = Source & {
  /** Named for screen readers, where there is no label. */
  asset?: string;
  /** What a screen reader says; empty where words beside it say the same. */
  label?: string;
  /** The colour of the hull in a place, in CSS; -1 stands for geometry that is no hull. */
  colors: (position: number) => string;
  hatched?: (position: number) => boolean;
  /** In CSS pixels; the picture fills its place without it. */
  width?: number;
  className?: string;
};

export function IdPicture({ asset, label, colors, hatched, width, className, ...source }: IdPictureProps) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const { map, current, failed } = useIdMap(source.png ? { png: source.png } : { url: source.url ?? "" });
  const look = useLook();
  const paint = useMemo(() => ({ color: (k: number) => rgb(colors(k)), hatched }), [colors, hatched]);
  useEffect(() => {
    // what was painted before stays until the next picture is there: its hulls are others
    if (!map || !current || !canvas.current) return;
    draw(canvas.current, new ImageData(painted(map, paint), map.width, map.height));
  }, [map, current, paint, look]);
  const said = label ?? (asset === undefined ? "Picture of an asset" : `Picture of ${asset}`);
  return (
    <div
      className={[css.picture, className].filter(Boolean).join(" ")}
      style={width === undefined ? undefined : { width }}
      role={said ? "img" : undefined}
      aria-label={said || undefined}
      aria-hidden={said ? undefined : true}
      data-state={map ? "there" : failed ? "failed" : "coming"}
    >
      <canvas ref={canvas} aria-hidden />
      {failed && !map && <span className={css.missing}>No picture</span>}
    </div>
  );
}

/** Draws a picture; one that is shown much smaller is made smaller first, as browsers leave its edges ragged. */
function draw(canvas: HTMLCanvasElement, image: ImageData): void {
  const wide = canvas.clientWidth * window.devicePixelRatio;
  const scale = wide > 0 && image.width > 2 * wide ? wide / image.width : 1;
  canvas.width = Math.round(image.width * scale);
  canvas.height = Math.round(image.height * scale);
  // kept by the processor, so that it is painted into the page and not a layer of its own that each frame puts together
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context || scale === 1) return context?.putImageData(image, 0, 0);
  const whole = new OffscreenCanvas(image.width, image.height);
  whole.getContext("2d")?.putImageData(image, 0, 0);
  context.imageSmoothingQuality = "high";
  context.drawImage(whole, 0, 0, canvas.width, canvas.height);
}
