// The readings of a rule: in which order they are listed, how the choices of a question differ, and which assets tell
// them apart.
import { api } from "../server/api";
import type { OutcomeView, ProgramView, CandidateView, ReviewChoiceView, RuleView } from "../wire";
import { useProject } from "./project";
import { countText, listText } from "./words";

type FamilySelection = Readonly<Record<string, readonly number[]>>;

interface Rival {
  readonly belief: number;
  readonly assets: FamilySelection;
}

/**
 * Assets on which it is enough to say what a reading selects so that no rival is left, as few as is easily found; the
 * first rules out the most belief. A rival that does the same everywhere needs no telling.
 */
export function chooseSeparating(own: FamilySelection, rivals: readonly Rival[], most = 3): string[] {
  const chosen: string[] = [];
  let left = rivals;
  while (left.length && chosen.length < most) {
    const [asset, gain] = bestAsset(own, left);
    if (asset === null || gain === 0) break;
    chosen.push(asset);
    left = left.filter((rival) => isSame(own[asset], rival.assets[asset]));
  }
  return chosen;
}

function bestAsset(own: FamilySelection, rivals: readonly Rival[]): [string | null, number] {
  let found: [string | null, number] = [null, 0];
  for (const [asset, positions] of Object.entries(own)) {
    const out = rivals.filter((rival) => !isSame(positions, rival.assets[asset]));
    const gain = out.reduce((sum, rival) => sum + Math.max(rival.belief, 1e-6), 0);
    if (gain > found[1]) found = [asset, gain];
  }
  return found;
}

function isSame(a: readonly number[] | undefined, b: readonly number[] | undefined): boolean {
  return a === b || (a !== undefined && b !== undefined && a.length === b.length && a.every((k) => b.includes(k)));
}

/** So many of the most believable readings are distinguished; the others hardly matter. */
const RIVALS = 8;

/** Assets on which an answer distinguishes a reading from the others of its rule. */
export async function findSeparatingAssets({ id, rule, extractor, differs_on }: CandidateView): Promise<string[]> {
  const readings = (useProject.getState().outcome?.candidates ?? []).filter((other) => other.rule === rule && other.id !== id);
  const rivals = [...readings].sort((a, b) => b.belief - a.belief).slice(0, RIVALS);
  const own = await selectEverywhere(extractor, rule);
  const known: Rival[] = [];
  for (const { belief, extractor: other } of rivals) known.push({ belief, assets: await selectEverywhere(other, rule) });
  const found = chooseSeparating(own, known);
  return found.length ? found : differs_on.slice(0, 1);
}

/** What an extractor selects on all assets; asked once more, as the server drops a request for a newer one. */
async function selectEverywhere(extractor: string, rule: number): Promise<FamilySelection> {
  const asked = await api.generalise(extractor, rule).catch(() => api.generalise(extractor, rule));
  return asked.assets;
}

/** The readings of a rule, the one of the program first, then the most believable. */
export function readingsOf(outcome: OutcomeView | null, rule: RuleView): readonly CandidateView[] {
  const own = extractorOf(rule.text);
  const rows = (outcome?.candidates ?? []).filter((reading) => reading.rule === rule.rule);
  const taken = (reading: CandidateView): number => Number(reading.extractor === own);
  return [...rows].sort((a, b) => taken(b) - taken(a) || b.belief - a.belief);
}

/** The extractor of a rule's text; an arrow in a quoted label is no end of it. */
export function extractorOf(rule: string): string {
  const found = /^((?:"(?:[^"\\\n]|\\.)*"|[^"])*?)=>/.exec(rule);
  return (found?.[1] ?? rule).trim();
}

/** What a choice of a question takes; a later one by how it differs from the first, where that says it shorter. */
export function choiceText(choices: readonly Pick<ReviewChoiceView, "select">[], k: number): string {
  const own = choices[k]?.select ?? [];
  const first = choices[0]?.select ?? [];
  if (!own.length) return "No hull";
  const more = own.filter((name) => !first.includes(name));
  const less = first.filter((name) => !own.includes(name));
  const count = countText(own.length, "hull");
  if (k === 0 || more.length + less.length >= own.length) return count;
  const parts = [more.length ? ` and ${listText(more)}` : "", less.length ? ` without ${listText(less)}` : ""];
  return `${count}: those of 1${parts.filter(Boolean).join(",")}`;
}

/** The hulls that a choice takes. */
export const selectOf = ({ select }: Pick<ReviewChoiceView, "select">): readonly string[] => select ?? [];

/** Names that are in some of the sets but not in all. */
export function differing(sets: readonly (readonly string[])[]): string[] {
  const names = new Set(sets.flat());
  return [...names].filter((name) => !sets.every((set) => set.includes(name)));
}

/** Whether what was learned is another program than the accepted one. */
export function learnedDiffers(program: ProgramView, outcome: OutcomeView | null): boolean {
  return outcome?.program != null && outcome.program.trim() !== program.text.trim();
}
