// The colour of each hull under the rule that the person chose; distinct ones so that neighbours differ and a hull
// keeps its colour through edits.
import { oncePer } from "../store/once";
import type { Scene } from "../store/scenes";
import { neighboursOf } from "../store/selection";
import type { ColorBy } from "../store/workspace";
import type { HullView, VocabularyLabel } from "../wire";

/** How a colour is laid on: dotted for a label that is guessed, hatched for one that is not sure. */
export type Fill = "solid" | "dotted" | "hatched";

/** A colour, null for the grey of what has none. */
export interface Tone {
  readonly color: string | null;
  readonly fill: Fill;
}

const FILLS = { given: "solid", guessed: "dotted", unsure: "hatched" } as const;

/** How the label of a hull is shown, also where that is none of the parts. */
export const fillOf = ({ look }: Pick<HullView, "look">): Fill => (look === null ? "solid" : FILLS[look]);

/** The colours of a scene's hulls. */
export function tonesOf(scene: Scene, by: ColorBy, vocabulary: readonly VocabularyLabel[]): (hull: HullView) => Tone {
  const places = distinctPlaces(scene);
  const labels = new Map(vocabulary.map(({ name, color }) => [name, color]));
  const plain = (color: string | null): Tone => ({ color, fill: "solid" });
  switch (scene.showing.kind === "hulls" ? "hull" : by) {
    case "hull":
      return ({ name }) => plain(PALETTE[places.get(name) ?? 0] ?? null);
    case "body":
      return ({ body }) => plain(PALETTE[scene.view.bodies.indexOf(body) % PALETTE.length] ?? null);
    case "label":
      return (hull) => ({ color: labels.get(hull.label ?? "") ?? null, fill: fillOf(hull) });
  }
}

/** Colours of one lightness each half, evenly around the wheel. */
export const PALETTE: readonly string[] = [
  "#80abf3", "#e0995c", "#83bd76", "#db8dc2", "#bcac50", "#42bbdd", "#ea8c8d", "#42c2ad", "#b69ae9",
  "#a9823c", "#4a91bf", "#819249", "#a475af", "#bd735a", "#219ba1", "#7d82c5", "#4c9c74", "#ba6f87",
];

/** The place in the palette of each hull by name; hulls that were made come after those of the file. */
export const distinctPlaces = oncePer((scene: Pick<Scene, "hulls" | "view" | "contacts">): ReadonlyMap<string, number> => {
  const out = new Map<string, number>();
  const beside = neighboursOf(scene);
  assignColors(scene.view.hulls.map((hull) => hull.name), neighboursOf(scene.view), out);
  const made = scene.hulls.filter((hull) => !out.has(hull.name));
  for (const { name, parent } of made) {
    const inherited = parent === null ? undefined : out.get(parent);
    if (inherited !== undefined && !placesTaken(beside.get(name) ?? [], out).has(inherited)) out.set(name, inherited);
  }
  assignColors(made.map((hull) => hull.name).filter((name) => !out.has(name)), beside, out);
  return out;
});

/** Gives each name the next colour that no neighbour has; the least used where they have all. */
function assignColors(names: readonly string[], beside: ReturnType<typeof neighboursOf>, out: Map<string, number>): void {
  names.forEach((name, k) => {
    const used = placesTaken(beside.get(name) ?? [], out);
    const order = PALETTE.map((_, step) => (k + step) % PALETTE.length);
    out.set(name, order.find((place) => !used.has(place)) ?? k % PALETTE.length);
  });
}

function placesTaken(names: Iterable<string>, places: ReadonlyMap<string, number>): Set<number> {
  return new Set([...names].flatMap((name) => places.get(name) ?? []));
}
