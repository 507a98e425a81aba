// The contact graph of what is shown: dots, lines, and the gaps of near misses that are pointed at.
import { useDesk } from "../../store/desk";
import type { Scene } from "../../store/scenes";
import type { Side } from "../drawing/side";
import type { GraphLine, GraphNode } from "../drawing/contacts";
import type { Point } from "../shapes/merged";

export interface Gap {
  readonly at: Point;
  /** [m] */
  readonly gap: number;
}

export interface Graph {
  readonly nodes: readonly GraphNode[];
  readonly lines: readonly GraphLine[];
  readonly gaps: readonly Gap[];
}

const MOST_GAPS = 12;

export function graphOf(side: Side, explode: number): Graph {
  const { selection, hover, hidden } = useDesk.getState();
  const isStrong = (name: string) => selection.has(name) || hover === name;
  const at = (name: string): Point | null => {
    const k = side.hulls.places.get(name);
    return k === undefined || hidden.has(name) ? null : side.hulls.middle(k, explode);
  };
  const pairs = pairsOf(side.scene).flatMap(({ a, b, gap }) => {
    const [from, to] = [at(a), at(b)];
    return from && to ? [{ a: from, b: to, gap, touching: gap === null, strong: isStrong(a) || isStrong(b) }] : [];
  });
  const nodes = side.scene.hulls.flatMap(({ name }) => {
    const here = at(name);
    return here ? [{ at: here, strong: isStrong(name) }] : [];
  });
  const gaps = pairs.flatMap(({ a, b, gap, strong }) => (strong && gap !== null ? [{ at: middle(a, b), gap }] : []));
  return { nodes, lines: pairs, gaps: gaps.slice(0, MOST_GAPS) };
}

/** Contacts, and near misses between hulls that are as they come; gap: null for a contact. */
function pairsOf(scene: Scene): { a: string; b: string; gap: number | null }[] {
  const made = new Set(scene.edit?.made ?? []);
  const near = scene.view.near_misses.filter(({ a, b }) => !made.has(a) && !made.has(b));
  return [...scene.contacts.map(([a, b]) => ({ a, b, gap: null })), ...near];
}

const middle = (a: Point, b: Point): Point => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2];
