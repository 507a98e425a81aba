// What lies over the picture: bars, lines of text and the view cube in it, and the card of the tour.
import type { Rect } from "../camera/fit";

/** Parts of the window that may lie over the view without being in it. */
const CARDS = '[role="dialog"][data-modeless]';
/** So thin a thing covers nothing [px]. */
const THIN = 12;
/** What reaches over so much of the picture is a layer to draw on, or a line across it. */
const LAYER = 0.95;
/** Free space around each [px]. */
const GAP = 8;

/** The rectangles of what lies over an element, in its own pixels. */
export function coversOf(picture: HTMLElement): Rect[] {
  const place = picture.getBoundingClientRect();
  const beside = [...(picture.parentElement?.children ?? [])].filter((one) => one !== picture);
  return [...beside, ...document.querySelectorAll(CARDS)].flatMap((one) => {
    const { left, top, right, bottom, width, height } = one.getBoundingClientRect();
    if (Math.min(width, height) < THIN || height > LAYER * place.height) return [];
    return [{ left: left - place.left - GAP, top: top - place.top - GAP, right: right - place.left + GAP, bottom: bottom - place.top + GAP }];
  });
}
