// Distinct colours for hulls, so that neighbours differ and a hull keeps its colour through edits.
import type { Scene } from "../../store/scenes";

/** Colours of one lightness each half, evenly around the wheel. */
export const PALETTE: readonly string[] = [
  "#80abf3", "#e0995c", "#83bd76", "#db8dc2", "#bcac50", "#42bbdd", "#ea8c8d", "#42c2ad", "#b69ae9",
  "#a9823c", "#4a91bf", "#819249", "#a475af", "#bd735a", "#219ba1", "#7d82c5", "#4c9c74", "#ba6f87",
];

type Pairs = readonly (readonly [string, string])[];

/** The place in the palette of each hull by name; hulls that were made come after those of the file. */
export function distinctPlaces(scene: Colored): ReadonlyMap<string, number> {
  const places = known.get(scene) ?? placesOf(scene);
  known.set(scene, places);
  return places;
}

type Colored = Pick<Scene, "hulls" | "view" | "contacts">;
const known = new WeakMap<Colored, ReadonlyMap<string, number>>();

function placesOf(scene: Colored): ReadonlyMap<string, number> {
  const out = new Map<string, number>();
  spread(scene.view.hulls.map((hull) => hull.name), scene.view.contacts, out);
  const made = scene.hulls.filter((hull) => !out.has(hull.name));
  for (const { name, parent } of made) {
    const inherited = parent === null ? undefined : out.get(parent);
    if (inherited !== undefined && !taken(neighboursOf(scene.contacts, name), out).has(inherited)) out.set(name, inherited);
  }
  spread(made.map((hull) => hull.name).filter((name) => !out.has(name)), scene.contacts, out);
  return out;
}

/** Gives each name the next colour that no neighbour has; the least used where they have all. */
function spread(names: readonly string[], contacts: Pairs, out: Map<string, number>): void {
  const beside = byName(contacts);
  names.forEach((name, k) => {
    const used = taken(beside.get(name) ?? [], out);
    const order = PALETTE.map((_, step) => (k + step) % PALETTE.length);
    out.set(name, order.find((place) => !used.has(place)) ?? k % PALETTE.length);
  });
}

function taken(names: Iterable<string>, places: ReadonlyMap<string, number>): Set<number> {
  return new Set([...names].flatMap((name) => places.get(name) ?? []));
}

function neighboursOf(contacts: Pairs, name: string): string[] {
  return contacts.flatMap(([a, b]) => (a === name ? [b] : b === name ? [a] : []));
}

function byName(contacts: Pairs): Map<string, string[]> {
  const out = new Map<string, string[]>();
  for (const [a, b] of contacts) {
    out.set(a, [...(out.get(a) ?? []), b]);
    out.set(b, [...(out.get(b) ?? []), a]);
  }
  return out;
}
