// Pictures of the server tell which hull each pixel shows, not its colour; the page colours them.
import { decode } from "fast-png";
import type { Fill } from "./hullColors";

/** Of each pixel, row by row: the position of the hull plus 1 in two bytes, the higher one first, 0 where there is none or
 * a non-convex piece; then its shade, 0 dark to 255 light, and its coverage, 0 nothing to 255 all. */
export interface IdMap {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8Array;
}

export type Rgb = readonly [number, number, number];

/** How each hull is coloured; position -1 stands for non-convex pieces. */
export interface Paint {
  color(position: number): Rgb;
  /** Outlined: within a dark line, as what is pointed out. */
  fill?(position: number): Fill | "outlined";
}

/** Reads a PNG byte for byte: a browser's canvas would round what lies under a half covered pixel, and with it the number
 * of the hull. */
export function readIdMap(png: Uint8Array): IdMap {
  const { width, height, data, channels, depth } = decode(png);
  if (channels !== 4 || depth !== 8 || !(data instanceof Uint8Array)) throw new Error("another kind of PNG");
  return { width, height, data };
}

/** The position of the hull in a pixel, -1 for none. */
export const hullAt = (data: Uint8Array, pixel: number): number => (((data[4 * pixel] ?? 0) << 8) | (data[4 * pixel + 1] ?? 0)) - 1;

const STRIPE = 10; // pixels from one stripe of a hatching to the next, along the row
const BARE = 4; // of which the ground shows
const DOT = 6; // pixels from one dot to the next; each is a square of two
const PALE = 0.5; // how much white is between dots
const LINE = 2; // pixels that an outline is wide

/** The picture in colour, as red, green, blue and alpha of each pixel. */
export function paintPixels(map: IdMap, paint: Paint): Uint8ClampedArray<ArrayBuffer> {
  const { width, data } = map;
  const out = new Uint8ClampedArray(data.length);
  const colors = new Map<number, { color: Rgb; fill: Fill | "outlined" }>();
  for (let k = 0; 4 * k < data.length; k++) {
    const coverage = data[4 * k + 3] ?? 0;
    if (coverage === 0) continue;
    const position = hullAt(data, k);
    let look = colors.get(position);
    if (!look) {
      look = { color: paint.color(position), fill: paint.fill?.(position) ?? "solid" };
      colors.set(position, look);
    }
    const [x, y] = [k % width, Math.floor(k / width)];
    const paler = look.fill === "dotted" ? PALE : look.fill === "hatched" && (x + y) % STRIPE < BARE ? 0.72 : 0;
    const isDot = look.fill === "dotted" && x % DOT < 2 && (y + (Math.floor(x / DOT) % 2) * (DOT / 2)) % DOT < 2;
    const isLine = look.fill === "outlined" && isEdge(map, x, y);
    const light = ((data[4 * k + 2] ?? 0) / 255) * (isDot ? 0.7 : isLine ? 0.25 : 1);
    for (let c = 0; c < 3; c++) {
      const value = (look.color[c as 0 | 1 | 2] ?? 0) * light;
      out[4 * k + c] = value + paler * (255 * light - value);
    }
    out[4 * k + 3] = coverage;
  }
  return out;
}

/** Whether the edge of what a pixel shows is near it. */
function isEdge({ width, height, data }: IdMap, x: number, y: number): boolean {
  const idAt = (u: number, v: number) => (u < 0 || v < 0 || u >= width || v >= height ? -1 : hullAt(data, v * width + u));
  const own = idAt(x, y);
  return idAt(x - LINE, y) !== own || idAt(x + LINE, y) !== own || idAt(x, y - LINE) !== own || idAt(x, y + LINE) !== own;
}
