// Which of two shapes is shown where their faces lie in one plane: each has a layer, and the lower one is in front. Without
// that the rounding of depths decides in each pixel, and another way as soon as the camera moves.
import { rangeOf } from "../../store/vectors";

/** Boxes nearer than this share of the whole are taken to touch. */
const NEAR = 1e-4;

/** A layer for each shape by its box (six numbers); shapes whose boxes touch are in different layers. */
export function layersOf(boxes: Float32Array): Float32Array {
  const beside = touching(boxes);
  const out = new Float32Array(boxes.length / 6).fill(-1);
  beside.forEach((others, k) => {
    const taken = new Set(others.map((other) => out[other]));
    let layer = 0;
    while (taken.has(layer)) layer++;
    out[k] = layer;
  });
  return out;
}

/** For each box those that touch it; found along the first axis, as the rest are few. */
function touching(boxes: Float32Array): number[][] {
  const at = (k: number, side: number) => boxes[6 * k + side] ?? 0;
  const count = boxes.length / 6;
  const [low, high] = rangeOf(boxes);
  const gap = NEAR * Math.max(high - low, 0);
  const order = Array.from({ length: count }, (_, k) => k).sort((a, b) => at(a, 0) - at(b, 0));
  const out: number[][] = order.map(() => []);
  const meet = (a: number, b: number) => [1, 2].every((axis) => at(a, axis) <= at(b, axis + 3) + gap && at(b, axis) <= at(a, axis + 3) + gap);
  order.forEach((a, place) => {
    for (let next = place + 1; next < count; next++) {
      const b = order[next] ?? 0;
      if (at(b, 0) > at(a, 3) + gap) break;
      if (!meet(a, b)) continue;
      out[a]?.push(b);
      out[b]?.push(a);
    }
  });
  return out;
}
