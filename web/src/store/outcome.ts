// What a outcome came to, in words, and what a rule reaches; knows neither DOM nor three.js.
import type { AssessmentView, OutcomeView, Reach } from "../wire";
import { leftText, moodOf, signedText } from "./assessment";
import { sampleText, countText, listText, shortName } from "./words";

/** How learning stands: a title, what more there is to say, and whether that is good. */
export interface Summary {
  mood: "plain" | "good" | "warn" | "bad";
  title: string;
  more: string | null;
}

/** From which belief on another reading is worth a look; the same as in the synthesis. */
const BELIEVABLE = 0.005;

/** How sure the edits are: what is known of that, whether it is being worked out, what is open (`openText`), and `countSigned`. */
type Sureness = { assessment: AssessmentView | null; assessing: boolean; goals?: string | null; signed?: number };

/** assets: how many there are to be learned from; sure: without it nothing is known of how sure the edits are. */
export function summarizeOutcome(
  outcome: OutcomeView | null,
  assets: number,
  sure: Sureness = { assessment: null, assessing: false },
): Summary {
  if (!outcome) return summary("plain", "No demonstration yet", "Demonstrate the steps on an asset; MeshForge then learns the program.");
  switch (outcome.status) {
    case "found":
      return summarizeFamily(outcome.unambiguous ? sameText(outcome.looked_at, assets) : differText(outcome), sure);
    case "ambiguous":
      return summary("warn", "One question is open", "The program fits your demonstrations; your answer decides the rest.");
    case "repair": {
      const labels = countText(outcome.repairs, "label");
      return summary("warn", `${labels} may be wrong`, `With ${outcome.repairs === 1 ? "it" : "them"} repaired, a program fits.`);
    }
    case "none":
      return summary("bad", `No program${outcome.nearest ? ` yet: rule ${outcome.nearest.rule} cannot be expressed` : ""}`, outcome.why);
    case "timeout":
      return summary("warn", `Stopped at rule ${outcome.rules.length + 1}`, "The earlier rules are learned. Learn again, or demonstrate this rule on another asset.");
    case "error":
      return summary("bad", "Learning failed", [outcome.error, AFTER_FAILURE].filter(Boolean).join("\n"));
  }
}

const AFTER_FAILURE = "Learn again. If it fails again, undo your last change (Ctrl+Z), or demonstrate on another asset.";

/** A program that fits: how sure its edits are; readings: what is known of those. */
function summarizeFamily(readings: string | null, { assessment, assessing, goals = null, signed }: Sureness): Summary {
  if (assessment?.assets.length) return summary(moodOf(assessment, goals), signedText(assessment, signed), [leftText(assessment, goals), readings].filter(Boolean).join("\n") || null);
  const wait = assessing ? "How sure its edits are is being worked out…" : "How sure its edits are is not known.";
  return summary("plain", "A program fits all your demonstrations", wait);
}

function sameText(lookedAt: number, assets: number): string {
  const all = assets === 1 ? "your one asset" : `your ${countText(assets, "asset")}`;
  const where = lookedAt < assets ? `the ${countText(lookedAt, "asset")} looked at, of ${all}` : all;
  return `All readings select the same hulls on ${where}.`;
}

function differText(outcome: OutcomeView): string | null {
  const open = outcome.candidates.filter((reading) => reading.belief >= BELIEVABLE && reading.differs_on.length > 0);
  if (!open.length) return null;
  const rules = [...new Set(open.map((reading) => reading.rule))].sort((a, b) => a - b);
  const assets = [...new Set(open.flatMap((reading) => reading.differs_on))].sort();
  const who = `Rule${rules.length > 1 ? "s" : ""} ${listText(rules.map(String))}`;
  return `${who} may select other hulls on ${listText(assets.map(shortName), 3)}.`;
}

const summary = (mood: Summary["mood"], title: string, more: string | null): Summary => ({ mood, title, more });

/** On how many assets something is selected, how many hulls in all, and how many assets were looked at for that. */
export interface Coverage {
  readonly hulls: number;
  readonly assets: number;
  readonly lookedAt: number;
}

/** counts: hulls that are selected on each asset. */
export function coverageOf(counts: readonly number[], lookedAt = counts.length): Coverage {
  const hulls = counts.reduce((sum, count) => sum + count, 0);
  return { hulls, assets: counts.filter((count) => count > 0).length, lookedAt };
}

/** How far a rule (from 1) reaches; null while it is not known. */
export function coverageOfRule(reach: Readonly<Record<string, Reach>>, rule: number): Coverage | null {
  const rows = Object.values(reach);
  const counts = rows.flatMap(({ rules }) => rules[rule - 1]?.length ?? []);
  return counts.length ? coverageOf(counts, rows.length) : null;
}

/** assets: how many there are. */
export function coverageText({ hulls, assets, lookedAt }: Coverage, all: number): string {
  const of = sampleText(lookedAt, all);
  return hulls ? `${countText(hulls, "hull")} on ${countText(assets, "asset")}${of}` : `selects nothing on any asset${of}`;
}

