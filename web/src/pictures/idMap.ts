// Pictures of the server tell which hull each pixel shows, not its colour; the page colours them.
import type { Fill } from "./hullColors";
import type { Pixels } from "./png";

export interface IdMap {
  readonly width: number;
  readonly height: number;
  /** Position of the hull plus 1; 0 where there is none, or a non-convex piece. */
  readonly ids: Uint16Array;
  /** 0 dark to 255 light. */
  readonly shade: Uint8Array;
  /** 0 nothing to 255 all. */
  readonly coverage: Uint8Array;
}

export type Rgb = readonly [number, number, number];

/** How each hull is coloured; position -1 stands for non-convex pieces. */
export interface Paint {
  color(position: number): Rgb;
  /** Outlined: within a dark line, as what is pointed out. */
  fill?(position: number): Fill | "outlined";
}

export function readIdMap({ width, height, data }: Pixels): IdMap {
  const count = width * height;
  const map = { width, height, ids: new Uint16Array(count), shade: new Uint8Array(count), coverage: new Uint8Array(count) };
  for (let k = 0; k < count; k++) {
    map.ids[k] = ((data[4 * k] ?? 0) << 8) | (data[4 * k + 1] ?? 0);
    map.shade[k] = data[4 * k + 2] ?? 0;
    map.coverage[k] = data[4 * k + 3] ?? 0;
  }
  return map;
}

const STRIPE = 10; // pixels from one stripe of a hatching to the next, along the row
const BARE = 4; // of which the ground shows
const DOT = 6; // pixels from one dot to the next; each is a square of two
const PALE = 0.5; // how much white is between dots
const LINE = 2; // pixels that an outline is wide

/** The picture in colour, as red, green, blue and alpha of each pixel. */
export function paintPixels(map: IdMap, paint: Paint): Uint8ClampedArray<ArrayBuffer> {
  const out = new Uint8ClampedArray(4 * map.ids.length);
  const colors = new Map<number, { color: Rgb; fill: Fill | "outlined" }>();
  for (let k = 0; k < map.ids.length; k++) {
    const coverage = map.coverage[k] ?? 0;
    if (coverage === 0) continue;
    const position = (map.ids[k] ?? 0) - 1;
    let look = colors.get(position);
    if (!look) {
      look = { color: paint.color(position), fill: paint.fill?.(position) ?? "solid" };
      colors.set(position, look);
    }
    const [x, y] = [k % map.width, Math.floor(k / map.width)];
    const paler = look.fill === "dotted" ? PALE : look.fill === "hatched" && (x + y) % STRIPE < BARE ? 0.72 : 0;
    const isDot = look.fill === "dotted" && x % DOT < 2 && (y + (Math.floor(x / DOT) % 2) * (DOT / 2)) % DOT < 2;
    const isLine = look.fill === "outlined" && isEdge(map, x, y);
    const light = ((map.shade[k] ?? 0) / 255) * (isDot ? 0.7 : isLine ? 0.25 : 1);
    for (let c = 0; c < 3; c++) {
      const value = (look.color[c as 0 | 1 | 2] ?? 0) * light;
      out[4 * k + c] = value + paler * (255 * light - value);
    }
    out[4 * k + 3] = coverage;
  }
  return out;
}

/** Whether the edge of what a pixel shows is near it. */
function isEdge({ width, height, ids }: IdMap, x: number, y: number): boolean {
  const idAt = (u: number, v: number) => (u < 0 || v < 0 || u >= width || v >= height ? 0 : ids[v * width + u]);
  const own = idAt(x, y);
  return idAt(x - LINE, y) !== own || idAt(x + LINE, y) !== own || idAt(x, y - LINE) !== own || idAt(x, y + LINE) !== own;
}
