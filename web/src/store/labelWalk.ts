// Hulls whose label nobody gave, the least sure first: how many, and the walk in which each is labelled and then comes
// the next.
import type { Card, Job } from "../wire";
import { GIVEN, isUnsure, UNLABELLED } from "./family";
import { labelHulls, NO_PART, ownHulls } from "./labels";
import { oncePer } from "./once";
import { oncePerFamily, useProject } from "./project";
import { getDetails, useScenes } from "./scenes";
import { notify } from "./toasts";
import { lookFrom, openAsset, openStage, select, setBrush, setLayout, useWorkspace } from "./workspace";

/** A hull by its place in its asset; sure: the percentage of its label, as the card has it. */
interface Place {
  readonly asset: string;
  readonly position: number;
  readonly sure: number;
}

type Cards = Readonly<Record<string, Card>>;

/** All hulls whose label nobody gave, the least sure first; those alike in the order of the family. */
export function queueOf(cards: Cards, order: readonly string[]): readonly Place[] {
  const rows: Place[][] = [];
  for (const asset of order) {
    cards[asset]?.confidence.forEach((sure, position) => sure !== GIVEN && (rows[sure - UNLABELLED] ??= []).push({ asset, position, sure }));
  }
  return rows.flat();
}

/** The hull of a queue after one that is or was in it, or before it, starting again at the other end; null for none. */
export function nextPlace(queue: readonly Place[], order: readonly string[], from: Place | null, by: 1 | -1 = 1): Place | null {
  const rank = new Map(order.map((asset, k) => [asset, k]));
  const far = (one: Place, to: Place) =>
    one.sure - to.sure || (rank.get(one.asset) ?? 0) - (rank.get(to.asset) ?? 0) || one.position - to.position;
  const next = from && (by === 1 ? queue.find((one) => far(one, from) > 0) : queue.findLast((one) => far(one, from) < 0));
  return next ?? queue.at(by === 1 ? 0 : -1) ?? null;
}

/** Hulls of the family: all, with a label, those of which it is unsure, guessed or given, and on how many assets it is given. */
export const labelProgress = oncePerFamily((cards) => {
  const sum = { hulls: 0, labelled: 0, unsure: 0, guessed: 0, given: 0, assets: 0 };
  for (const { labels, confidence } of cards) {
    const given = confidence.filter((sure) => sure === GIVEN).length;
    const unsure = confidence.filter(isUnsure).length;
    sum.hulls += labels.length;
    sum.labelled += labels.filter((label) => label !== UNLABELLED).length;
    sum.unsure += unsure;
    sum.guessed += confidence.filter((sure) => sure !== UNLABELLED).length - unsure - given;
    sum.given += given;
    sum.assets += given ? 1 : 0;
  }
  return sum;
});

const walkOf = oncePer((cards: Cards) => queueOf(cards, useProject.getState().order));

/** Where a hull of an asset that is shown alone, by name, is in the walk (from 0), and how many are in it; null for one that
 * somebody labelled. */
export function placeInWalk(cards: Cards, asset: string, own: readonly { name: string }[], name: string): { at: number; of: number } | null {
  const walk = walkOf(cards);
  const at = walk.findIndex((one) => one.asset === asset && own[one.position]?.name === name);
  return at < 0 ? null : { at, of: walk.length };
}

/** The hull that the walk has put in hand. */
let current: (Place & { hull: string }) | null = null;

const isLabelling = (jobs: readonly Job[]): boolean =>
  jobs.some(({ kind, state }) => kind === "label" && state === "running");

// it begins anew where all labels are others
useProject.subscribe((now, before) => {
  if (isLabelling(before.jobs) && !isLabelling(now.jobs)) current = null;
});

/** Labels the selected hulls, or, where none is, arms the label so that clicks paint it; null takes labels away. */
export function applyLabel(label: string | null): void | Promise<void> {
  const { asset, selection, elsewhere, brush } = useWorkspace.getState();
  const hulls = ownHulls(selection);
  const paint = label ?? "";
  if (asset === null || (!hulls.length && !elsewhere.size)) return setBrush(brush === paint ? null : paint);
  setBrush(null);
  const others = [...elsewhere].flatMap(([other, names]) => names.map((hull) => ({ asset: other, hull })));
  if (others.length) return void labelHulls(asset, hulls, label, false, others);
  if (!isCurrent(asset, hulls)) return void labelHulls(asset, hulls, label);
  return labelHulls(asset, hulls, label, label !== null).then((done) => (done && label !== null ? walk() : undefined));
}

/** The labels of the selected hulls are right: the person vouches for them; then goes on to the next one of the walk. */
export async function confirmLabels(): Promise<void> {
  const { asset, selection } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset) return;
  const hulls = scene.hulls.filter((hull) => selection.has(hull.name) && hull.look !== null);
  const labels = [...new Set(hulls.map((hull) => hull.label))];
  const having = (label: string | null) => hulls.filter((hull) => hull.label === label).map((hull) => hull.name);
  for (const label of labels) if (!(await labelHulls(asset, having(label), label ?? NO_PART, true))) return;
  if (hulls.length) await walk();
}

/** Opens the asset of the next hull of the walk, or of the one before, selects the hull and looks at it. */
export async function walk(by: 1 | -1 = 1): Promise<void> {
  const { cards, order } = useProject.getState();
  const next = nextPlace(walkOf(cards), order, placeInHand(by), by);
  if (!next) return notify("Every label was given by you, a file or a name.");
  openStage("label");
  openAsset(next.asset);
  setLayout({ gallery: false });
  const { view } = await getDetails(next.asset);
  const hull = view.hulls[next.position];
  if (!hull || useWorkspace.getState().asset !== next.asset) return;
  select([hull.name]);
  lookFrom("near");
  current = { ...next, hull: hull.name };
}

/** The hull that is selected, by which the walk goes on; null where it begins anew. */
function placeInHand(by: 1 | -1): Place | null {
  const { asset, selection } = useWorkspace.getState();
  if (current && current.asset === asset && selection.has(current.hull)) return current;
  const { scene } = useScenes.getState();
  if (asset === null || scene?.asset !== asset || scene.parts) return null;
  const isSelected = (hull: { name: string }) => selection.has(hull.name);
  const position = by === 1 ? scene.view.hulls.findLastIndex(isSelected) : scene.view.hulls.findIndex(isSelected);
  const sure = useProject.getState().cards[asset]?.confidence[position] ?? GIVEN;
  return sure === GIVEN ? null : { asset, position, sure };
}

const isCurrent = (asset: string, hulls: readonly string[]): boolean =>
  current?.asset === asset && hulls.length === 1 && hulls[0] === current.hull;
