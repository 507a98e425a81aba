// The results of the family: what to look at, in which order, and numbers about one; knows neither DOM nor three.js.
import { create } from "zustand";
import { api } from "../server/api";
import type { Card, ConfidenceView, EditHeader, HullView } from "../wire";
import { failingGoals, hasOpenGoals } from "./goals";
import type { ProjectState } from "./project";
import { countText, listText } from "./words";

export type Group = "failed" | "wrong" | "flagged" | "stale" | "open" | "accepted" | "none" | "excluded";

/** In the order in which they want a look. */
export const GROUPS: readonly Group[] = ["failed", "wrong", "flagged", "stale", "open", "accepted", "none", "excluded"];

/** Where the result of an asset belongs. */
export function groupOf(card: Card): Group {
  if (card.excluded) return "excluded";
  if (card.output === "failed") return card.stale.length ? "stale" : "failed";
  if (card.output === "none") return "none";
  if (card.review === "wrong") return "wrong";
  if ((card.flags.length > 0 && card.review === null) || failingGoals(card).length) return "flagged";
  if (card.stale.length) return "stale";
  return card.review === "accepted" ? "accepted" : "open";
}

/** The cards by group, in the family's order. */
export function groupCards(cards: readonly Card[]): Readonly<Record<Group, readonly Card[]>> {
  const rows = Object.fromEntries(GROUPS.map((group) => [group, []])) as unknown as Record<Group, Card[]>;
  for (const card of cards) rows[groupOf(card)].push(card);
  return rows;
}

/** Assets that want a look: what failed, is wrong or flagged first, then those that nobody reviewed, then those that need
 * review though their results are not written as they are now. */
export function reviewQueue(cards: readonly Card[], confidence: Readonly<Record<string, ConfidenceView>> = {}): readonly string[] {
  const { failed, wrong, flagged, open, stale, none } = groupCards(cards);
  const held = [...stale, ...none].filter(({ asset }) => confidence[asset]?.state === "needs review");
  return [...failed, ...wrong, ...flagged, ...open, ...held].map((card) => card.asset);
}

/** The one of a queue that comes after an asset, from the front again at its end. */
export function nextInQueue(queue: readonly string[], order: readonly string[], asset: string | null): string | null {
  const at = queue.indexOf(asset ?? "");
  if (at >= 0) return queue[(at + 1) % queue.length] === asset ? null : (queue[(at + 1) % queue.length] ?? null);
  const places = new Map(order.map((name, k) => [name, k]));
  const here = places.get(asset ?? "") ?? -1;
  return queue.find((name) => (places.get(name) ?? -1) > here) ?? queue[0] ?? null;
}

/** Assets whose output is up to date, not called wrong, not flagged, legal as far as is known, and not held. */
export function listAcceptable(cards: readonly Card[], confidence: Readonly<Record<string, ConfidenceView>> = {}): readonly string[] {
  const isOpen = (card: Card) => groupOf(card) === "open" && confidence[card.asset]?.state !== "needs review";
  return cards.filter(isOpen).map((card) => card.asset);
}

/** Assets whose output is missing or older than what it is made of. */
export function listOutdated(cards: readonly Card[]): readonly string[] {
  return cards.filter(isOutdated).map((card) => card.asset);
}

const isOutdated = (card: Card): boolean => card.hulls !== null && (card.output === "none" || card.stale.length > 0);

/** Whether an asset has an output. */
export const isWritten = ({ output }: Pick<Card, "output">): boolean => output === "edited" || output === "unchanged";

/** Whether the output of an asset is there as it would be now. */
export const isUpToDate = (card: Card | undefined): boolean => card !== undefined && isWritten(card) && card.stale.length === 0;

/** Whether the output of an asset is up to date, and signed off: sure enough with no open goal, or accepted by a person. */
export const isSignedOff = (card: Card, sure: ConfidenceView | undefined): boolean =>
  isUpToDate(card) && (card.review === "accepted" || (card.review === null && sure?.state === "signed" && !hasOpenGoals(card)));

/** The outputs that an export takes. */
export const listExportable = (cards: readonly Card[], confidence: Readonly<Record<string, ConfidenceView>>) =>
  ({ signed: cards.filter((card) => isSignedOff(card, confidence[card.asset])), all: cards.filter(isWritten) }) as const;

/** Why most engines would make solid blocks of outputs, null where none is a mesh file of several hulls. */
export function solidText(outputs: readonly Card[], { merged_files, merged_by, engines }: Pick<ProjectState, "merged_files" | "merged_by" | "engines">): string | null {
  const files = outputs.filter(({ asset, after }) => (after ?? 0) > 1 && merged_files.some((suffix) => asset.toLowerCase().endsWith(`.${suffix}`)));
  if (!files.length || !merged_by.length) return null;
  const names = [...new Set(merged_by.map((name) => (engines[name] ?? name).split(" ")[0] ?? ""))];
  const [these, one] = [`hese ${countText(outputs.length, "output")}`, files.length === 1];
  const which = files.length === outputs.length ? (one ? "This output" : `T${these}`) : `${files.length} of t${these}`;
  return `${which} ${one ? "is a mesh file" : "are mesh files"} of several hulls, of which ${listText(names, names.length)} make one solid hull.`;
}

/** Numbers before and after an edit. */
export function numbersOf(before: readonly HullView[], edit: EditHeader) {
  const sum = (hulls: readonly HullView[], of: "vertices" | "faces"): number =>
    hulls.reduce((total, hull) => total + hull[of], 0);
  return {
    hulls: [before.length, edit.hulls.length],
    vertices: [sum(before, "vertices"), sum(edit.hulls, "vertices")],
    faces: [sum(before, "faces"), sum(edit.hulls, "faces")],
    volume: edit.volume,
  } as const;
}

/** What alarms of an asset begin with, by the number that each is about (`signoff/alarms.py`). */
const ALARMS: Readonly<Record<"hulls" | "volume", RegExp>> = {
  hulls: /^(number of hulls|no hull is left)/,
  volume: /^(volume|nearly one solid block|no hull is left|extents|\d+% of the)/,
};

/** Why the numbers of an asset stand out, for those that do. */
export function alarmsOf(row: Pick<ConfidenceView, "reasons"> | undefined): { hulls: string | null; volume: string | null } {
  const texts = row?.reasons.flatMap(({ kind, text }) => (kind === "alarm" ? [text] : [])) ?? [];
  const about = (what: keyof typeof ALARMS) => texts.find((text) => ALARMS[what].test(text)) ?? null;
  return { hulls: about("hulls"), volume: about("volume") };
}

/** What the check of legality says of an edited asset, at its worst. */
export function verdictOf(edit: EditHeader): "legal" | "doubtful" | "illegal" {
  const worst = (severity: "error" | "warning") => edit.findings.some((finding) => finding.severity === severity);
  return worst("error") ? "illegal" : worst("warning") ? "doubtful" : "legal";
}

/** Why outputs are stale, in words. */
export function staleText(reasons: readonly string[]): string {
  return reasons.map((reason) => STALE[reason] ?? `${reason} changed`).join(", ");
}

const STALE: Readonly<Record<string, string>> = {
  asset: "the asset changed",
  labels: "its labels changed",
  program: "the program changed",
  corrections: "its edits by hand changed",
  templates: "a template changed",
  preparation: "it was prepared differently",
  settings: "settings changed",
  software: "another version of MeshForge made it",
  output: "written files are gone",
};

type Verdict = ReturnType<typeof verdictOf>;

/** Whether written outputs are legal, asked for when one wants to know and kept as long as the output stays. */
export const useVerdicts = create<{ verdicts: Readonly<Record<string, Verdict>> }>()(() => ({ verdicts: {} }));

/** So many are worked out at once; the others wait in one of these lines. */
const lines: Promise<unknown>[] = [Promise.resolve(), Promise.resolve(), Promise.resolve()];
const requests = new Map<string, Promise<Verdict>>();

/** What a verdict is kept by: another output of the asset is another key. */
export const verdictKey = (card: Card): string => `${card.asset}\n${card.edited_picture ?? ""}`;

/** The verdict on a card's output. */
export function getVerdict(card: Card): Promise<Verdict> {
  const key = verdictKey(card);
  const known = requests.get(key);
  if (known) return known;
  const line = requests.size % lines.length;
  const mine = (lines[line] ?? Promise.resolve()).then(() => fetchVerdict(card.asset, key));
  lines[line] = mine.catch(() => requests.delete(key));
  requests.set(key, mine);
  return mine;
}

async function fetchVerdict(asset: string, key: string): Promise<Verdict> {
  const { header } = await api.result(asset, "output");
  const found = verdictOf(header);
  useVerdicts.setState(({ verdicts }) => ({ verdicts: { ...verdicts, [key]: found } }));
  return found;
}
