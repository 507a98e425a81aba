// The parts of a hull that likely spans them, shown in its place while a person is asked whether to split it so.
import { create } from "zustand";
import { api } from "../server/api";
import type { PartsPacket } from "../server/packet";
import type { Card, HullView } from "../wire";
import { percentText } from "./assessment";
import type { Scene, SceneHull } from "./scene";
import { reportError } from "./toasts";

interface HullPartsState {
  /** null while nobody is asked, or they are not fetched yet. */
  readonly shown: { readonly asset: string; readonly packet: PartsPacket } | null;
}

export const useHullParts = create<HullPartsState>()(() => ({ shown: null }));

/** Parts of one label. */
export interface PartGroup {
  readonly label: string;
  readonly count: number;
  /** How sure the label is, `93%` or `75% to 92%`. */
  readonly share: string;
}

/** Parts by their labels, in the order in which these come. */
export function groupParts(parts: readonly Pick<HullView, "label" | "confidence">[]): readonly PartGroup[] {
  const groups = new Map<string, number[]>();
  for (const { label, confidence } of parts) groups.set(label ?? "", [...(groups.get(label ?? "") ?? []), confidence ?? 0]);
  return [...groups].map(([label, shares]) => {
    const ends = [Math.min(...shares), Math.max(...shares)].map((share) => percentText(share));
    return { label, count: shares.length, share: [...new Set(ends)].join(" to ") };
  });
}

/** Shows the parts of a hull, until the returned function is called. */
export function showHullParts(asset: string, hull: string): () => void {
  let wanted = true;
  api.parts(asset, hull).then((packet) => wanted && useHullParts.setState({ shown: { asset, packet } }), (error: unknown) => {
    if (wanted) reportError(error);
  });
  return () => {
    wanted = false;
    useHullParts.setState({ shown: null });
  };
}

/** The hull of a scene that is shown as its parts; null where none is, as on other assets and on results. */
export function dividedHull({ asset, showing, hulls, parts }: Scene): SceneHull | null {
  const { shown } = useHullParts.getState();
  if (!shown || shown.asset !== asset || showing.kind !== "source" || parts) return null;
  return hulls.find(({ name }) => name === shown.packet.header.hull) ?? null;
}

/** The hulls of a scene that likely span parts, by name, in words; none on results and on several assets. */
export function spansOf({ asset, showing, parts }: Scene, cards: Readonly<Record<string, Card>>): Readonly<Record<string, string>> {
  return showing.kind !== "result" && !parts ? (cards[asset]?.spans ?? NO_SPANS) : NO_SPANS;
}

const NO_SPANS: Readonly<Record<string, string>> = {};

/** How many hulls of the family likely span parts. */
export const countSpans = (cards: Readonly<Record<string, Card>>): number =>
  Object.values(cards).reduce((sum, { spans }) => sum + Object.keys(spans).length, 0);
