// Which shapes a ray meets: boxes are tried before triangles, so hundreds of hulls take no time.
import { Box3, Ray as Line, Vector3 } from "three";
import { type MergedShapes, type Point, triangleAt } from "./triangles";

/** from, along: in the frame of the shapes. */
export interface Ray {
  readonly from: Point;
  readonly along: Point;
}

export interface RayHit {
  readonly place: number;
  /** How far along the ray, in lengths of `along`. */
  readonly distance: number;
}

/** Faces that a ray meets nearer to each other than this share of the way lie in one plane. */
const SAME = 1e-5;

type Cast<T> = (shapes: MergedShapes, ray: Ray, visible: readonly boolean[], aways: readonly Point[], explode: number) => T;

/** The first of them, null where the ray meets none. */
export const castRay: Cast<RayHit | null> = (...given) => castRayThrough(...given)[0] ?? null;

/**
 * All shapes on a ray among those that are in sight, the first one first; of those with faces in one plane, the one that is
 * drawn in front. aways, explode: how shapes are moved.
 */
export const castRayThrough: Cast<RayHit[]> = (shapes, ray, visible, aways, explode) => {
  const [from, along] = [new Vector3(...ray.from), new Vector3(...ray.along)];
  const hits: RayHit[] = [];
  for (let place = 0; place < shapes.count; place++) {
    if (!visible[place]) continue;
    line.set(from, along).origin.addScaledVector(away.fromArray(aways[place] ?? [0, 0, 0]), -explode);
    const distance = distanceTo(shapes, place);
    if (distance < Infinity) hits.push({ place, distance });
  }
  const first = ({ distance, place }: RayHit, other: RayHit) =>
    Math.abs(distance - other.distance) <= SAME * distance ? (shapes.layers[place] ?? 0) - (shapes.layers[other.place] ?? 0) : distance - other.distance;
  return hits.sort(first);
};

const [line, box, away, spot] = [new Line(), new Box3(), new Vector3(), new Vector3()];

/** How far along the line a shape is met; Infinity where it is not. */
function distanceTo({ boxes, positions, index, faces }: MergedShapes, k: number): number {
  box.min.fromArray(boxes, 6 * k);
  box.max.fromArray(boxes, 6 * k + 3);
  if (!line.intersectsBox(box)) return Infinity;
  let nearest = Infinity;
  for (let face = faces[k] ?? 0; face < (faces[k + 1] ?? 0); face++) {
    const { a, b, c } = triangleAt(positions, index, face);
    if (!line.intersectTriangle(a, b, c, false, spot)) continue;
    nearest = Math.min(nearest, spot.sub(line.origin).dot(line.direction) / line.direction.lengthSq());
  }
  return nearest;
}
