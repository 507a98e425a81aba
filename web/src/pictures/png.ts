// Reads the server's PNGs (8 bits, RGBA, not interlaced) byte for byte: a browser's canvas would round what lies
// under a half covered pixel, and with it the number of the hull.

export interface Pixels {
  readonly width: number;
  readonly height: number;
  /** Red, green, blue and alpha of each pixel, row by row. */
  readonly data: Uint8Array;
}

const SIGNATURE = [137, 80, 78, 71, 13, 10, 26, 10];

export async function readPng(bytes: Uint8Array<ArrayBuffer>): Promise<Pixels> {
  if (SIGNATURE.some((byte, k) => bytes[k] !== byte)) throw new Error("this is no PNG");
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let [width, height] = [0, 0];
  for (let at = 8; at + 12 <= bytes.length; ) {
    const length = view.getUint32(at);
    const kind = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (kind === "IHDR") {
      [width, height] = [view.getUint32(at + 8), view.getUint32(at + 12)];
      if (bytes[at + 16] !== 8 || bytes[at + 17] !== 6 || bytes[at + 20] !== 0) throw new Error("another kind of PNG");
    }
    if (kind === "IDAT") parts.push(bytes.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  return { width, height, data: removeFilters(await inflate(parts), width, height) };
}

async function inflate(parts: readonly Uint8Array<ArrayBuffer>[]): Promise<Uint8Array> {
  const stream = new Blob([...parts]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Takes the filters of the rows back (PNG specification, section 9). */
function removeFilters(raw: Uint8Array, width: number, height: number): Uint8Array {
  const row = 4 * width;
  if (raw.length < height * (row + 1)) throw new Error("the PNG is cut short");
  const out = new Uint8Array(height * row);
  let above: Uint8Array = new Uint8Array(row);
  for (let y = 0; y < height; y++) {
    const from = y * (row + 1);
    const line = out.subarray(y * row, (y + 1) * row);
    line.set(raw.subarray(from + 1, from + 1 + row));
    BACK[raw[from] ?? 0]?.(line, above);
    above = line;
  }
  return out;
}

type Filter = (line: Uint8Array, above: Uint8Array) => void;

/** By the number of the filter; each changes a row in place. A pixel has four bytes. */
const BACK: readonly Filter[] = [() => undefined, left, up, average, paeth];

function left(line: Uint8Array): void {
  for (let x = 4; x < line.length; x++) line[x] = at(line, x) + at(line, x - 4);
}

function up(line: Uint8Array, above: Uint8Array): void {
  for (let x = 0; x < line.length; x++) line[x] = at(line, x) + at(above, x);
}

function average(line: Uint8Array, above: Uint8Array): void {
  for (let x = 0; x < line.length; x++) line[x] = at(line, x) + ((at(line, x - 4) + at(above, x)) >> 1);
}

function paeth(line: Uint8Array, above: Uint8Array): void {
  for (let x = 0; x < line.length; x++) line[x] = at(line, x) + nearest(at(line, x - 4), at(above, x), at(above, x - 4));
}

/** The one of three neighbours that is nearest to left + up - corner. */
function nearest(l: number, u: number, corner: number): number {
  const toLeft = Math.abs(u - corner);
  const toUp = Math.abs(l - corner);
  const toCorner = Math.abs(l + u - 2 * corner);
  if (toLeft <= toUp && toLeft <= toCorner) return l;
  return toUp <= toCorner ? u : corner;
}

/** A byte of a row, 0 before its beginning. */
const at = (row: Uint8Array, x: number) => (x < 0 ? 0 : (row[x] ?? 0));
