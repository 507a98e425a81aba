// The room that cards have, and what of it is in sight.
import { type RefObject, useEffect, useLayoutEffect, useRef, useState } from "react";

/** The width inside an element, as it changes. */
export function useWidth(box: RefObject<HTMLElement | null>): number {
  const [width, setWidth] = useState(264);
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const measure = () => setWidth(element.clientWidth);
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    measure();
    return () => observer.disconnect();
  }, [box]);
  return width;
}

/** Scrolls to the asset that is opened, wherever that was done. */
export function useFollowed(
  asset: string | null,
  shown: readonly string[],
  columns: number,
  scrollTo: (row: number) => void,
): void {
  const latest = useRef({ shown, columns, scrollTo });
  useLayoutEffect(() => {
    latest.current = { shown, columns, scrollTo };
  });
  useEffect(() => {
    const { shown: all, columns: across, scrollTo: go } = latest.current;
    const at = asset === null ? -1 : all.indexOf(asset);
    if (at >= 0) go(Math.floor(at / across));
  }, [asset]);
}
