// Colours of CSS as numbers, and those that thumbnails take.
import { PALETTE } from "./hullColors";
import type { Rgb } from "./idMap";

let known = new Map<string, Rgb>();
let theme: string | undefined;
let brush: CanvasRenderingContext2D | null = null;

/** Any colour of CSS, `var(--name)` among them, as red, green and blue in 0..255. */
export function toRgb(color: string): Rgb {
  if (theme !== document.documentElement.dataset.theme) {
    theme = document.documentElement.dataset.theme;
    known = new Map();
  }
  const before = known.get(color);
  if (before) return before;
  const value = measureColor(resolveVariables(color));
  known.set(color, value);
  return value;
}

function resolveVariables(color: string): string {
  const page = getComputedStyle(document.documentElement);
  return color.replace(/var\((--[\w-]+)\)/g, (_, name: string) => page.getPropertyValue(name).trim());
}

function measureColor(color: string): Rgb {
  brush ??= Object.assign(document.createElement("canvas"), { width: 1, height: 1 }).getContext("2d", {
    willReadFrequently: true,
  });
  if (!brush) return [128, 128, 128];
  brush.fillStyle = color;
  brush.fillRect(0, 0, 1, 1);
  const [r = 0, g = 0, b = 0] = brush.getImageData(0, 0, 1, 1).data;
  return [r, g, b];
}

/** Calls back when the theme changes, until the returned function is called. */
export function watchTheme(changed: () => void): () => void {
  const watcher = new MutationObserver(changed);
  watcher.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  return () => watcher.disconnect();
}

/** Of hulls of which only the place is known: as the view has them, yet paler, since it says less. */
export const hueOf = (position: number): string =>
  `color-mix(in srgb, ${PALETTE[position % PALETTE.length] ?? "gray"} 55%, var(--hull-pale))`;
