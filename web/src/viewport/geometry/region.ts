// Regions of the picture that a person draws, a box or a lasso, and what lies in them.

export type Spot = readonly [x: number, y: number];
export type Region = readonly Spot[];

export function boxRegion([x0, y0]: Spot, [x1, y1]: Spot): Region {
  return [
    [x0, y0],
    [x1, y0],
    [x1, y1],
    [x0, y1],
  ];
}

/** Whether a spot is inside, by counting the borders to its right. */
export function isInside(region: Region, [x, y]: Spot): boolean {
  return rowSpans(region, y).filter((border) => x < border).length % 2 === 1;
}

/** The parts of a line of pixels that are inside, as pairs of ends. */
function rowSpans(region: Region, y: number): number[] {
  const crossings: number[] = [];
  region.forEach(([x1, y1], k) => {
    const [x0, y0] = region[(k + region.length - 1) % region.length] ?? [0, 0];
    if (y0 > y !== y1 > y) crossings.push(x0 + ((y - y0) / (y1 - y0)) * (x1 - x0));
  });
  return crossings.sort((a, b) => a - b);
}

/** Which places are seen inside, by a picture that has for every pixel the place plus one; rows from the top. */
export function placesInside(region: Region, places: Uint32Array, width: number, height: number): Set<number> {
  const out = new Set<number>();
  const rows = region.map(([, y]) => y);
  const last = Math.min(height - 1, Math.ceil(Math.max(...rows)));
  for (let y = Math.max(0, Math.floor(Math.min(...rows))); y <= last; y++) {
    const ends = rowSpans(region, y + 0.5);
    for (let k = 0; k + 1 < ends.length; k += 2) {
      const stop = Math.min(width - 1, Math.floor((ends[k + 1] ?? 0) - 0.5));
      for (let x = Math.max(0, Math.ceil((ends[k] ?? 0) - 0.5)); x <= stop; x++) {
        const place = places[y * width + x] ?? 0;
        if (place > 0) out.add(place - 1);
      }
    }
  }
  return out;
}
