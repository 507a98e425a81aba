// The faces of many hulls in one buffer, and their edges in another, sharp ones first.
import { BufferAttribute, BufferGeometry } from "three";
import type { Shape } from "../../server/packet";
import { EDGE, type Edges } from "../shapes/edges";
import { type Facets, facetsOf } from "../shapes/facets";
import type { Point } from "../shapes/merged";

/** Faces of all hulls; each vertex knows the place of its hull, and where that drifts in the exploded view. */
export function faceGeometry(shapes: readonly Shape[], aways: readonly Point[]): BufferGeometry {
  const parts = shapes.map(keptFacets);
  const vertices = parts.reduce((sum, part) => sum + part.positions.length / 3, 0);
  const corners = parts.reduce((sum, part) => sum + part.index.length, 0);
  const [positions, normals] = [new Float32Array(3 * vertices), new Float32Array(3 * vertices)];
  const [owner, index] = [new Float32Array(vertices), new Uint32Array(corners)];
  let [vertex, corner] = [0, 0];
  parts.forEach((part, k) => {
    const many = part.positions.length / 3;
    positions.set(part.positions, 3 * vertex);
    normals.set(part.normals, 3 * vertex);
    owner.fill(k, vertex, vertex + many);
    for (const at of part.index) index[corner++] = at + vertex;
    vertex += many;
  });
  const out = geometryOf(positions, owner, aways);
  out.setAttribute("normal", new BufferAttribute(normals, 3));
  out.setIndex(new BufferAttribute(index, 1));
  return out;
}

const known = new WeakMap<Shape, Facets>();

function keptFacets(shape: Shape): Facets {
  const facets = known.get(shape) ?? facetsOf(shape);
  known.set(shape, facets);
  return facets;
}

/** Lines of all hulls; sharp: how many vertices those of the sharp edges have. */
export function lineGeometry(edges: readonly Edges[], aways: readonly Point[]): { geometry: BufferGeometry; sharp: number } {
  const total = edges.reduce((sum, { records }) => sum + records.length / EDGE, 0);
  const ends = new Float32Array(6 * total);
  const owner = new Float32Array(2 * total);
  let at = 0;
  const add = (k: number, records: Float32Array, first: number, last: number) => {
    for (let e = first; e < last; e++, at++) {
      ends.set(records.subarray(e * EDGE, e * EDGE + 6), 6 * at);
      owner.fill(k, 2 * at, 2 * at + 2);
    }
  };
  edges.forEach(({ records, sharp }, k) => add(k, records, 0, sharp));
  const sharp = 2 * at;
  edges.forEach(({ records, sharp: first }, k) => add(k, records, first, records.length / EDGE));
  return { geometry: geometryOf(ends, owner, aways), sharp };
}

function geometryOf(positions: Float32Array, owner: Float32Array, aways: readonly Point[]): BufferGeometry {
  const away = new Float32Array(positions.length);
  for (let v = 0; v < owner.length; v++) away.set(aways[owner[v] ?? 0] ?? [0, 0, 0], 3 * v);
  const out = new BufferGeometry();
  out.setAttribute("position", new BufferAttribute(positions, 3));
  out.setAttribute("owner", new BufferAttribute(owner, 1));
  out.setAttribute("away", new BufferAttribute(away, 3));
  return out;
}
