// What a outcome came to, in words, and what a rule reaches; knows neither DOM nor three.js.
import type { OutcomeView, Reach } from "../wire";
import { sampleText, countText, listText, shortName } from "./words";

/** How learning stands: a title, what more there is to say, and whether that is good. */
export interface Summary {
  mood: "plain" | "good" | "warn" | "bad";
  title: string;
  more: string | null;
}

/** From which belief on another reading is worth a look; the same as in the synthesis. */
const BELIEVABLE = 0.005;

/** assets: how many there are to be learned from. */
export function summarizeOutcome(outcome: OutcomeView | null, assets: number): Summary {
  if (!outcome) return summary("plain", "No demonstration yet", "Demonstrate the steps on an asset; MeshForge then learns the program.");
  switch (outcome.status) {
    case "found":
      return outcome.settled ? summarizeUnambiguous(outcome.looked_at, assets) : summarizeFound(outcome);
    case "ambiguous":
      return summary("warn", "One question is open", "The program fits your demonstrations; your answer decides the rest.");
    case "repair": {
      const labels = countText(outcome.repairs.length, "label");
      return summary("warn", `${labels} may be wrong`, `With ${outcome.repairs.length === 1 ? "it" : "them"} repaired, a program fits.`);
    }
    case "none":
      return summary("bad", `No program${outcome.nearest ? ` yet: rule ${outcome.nearest.rule} cannot be expressed` : ""}`, outcome.why);
    case "timeout":
      return summary("warn", `Stopped at rule ${outcome.rules.length + 1}`, "The earlier rules are learned. Learn again, or demonstrate this rule on another asset.");
    case "error":
      return summary("bad", "Learning failed", outcome.error);
  }
}

function summarizeUnambiguous(lookedAt: number, assets: number): Summary {
  const all = assets === 1 ? "your one asset" : `your ${countText(assets, "asset")}`;
  const where = lookedAt < assets ? `the ${countText(lookedAt, "asset")} looked at, of ${all}` : all;
  return summary("good", "Unambiguous", `All readings select the same hulls on ${where}.`);
}

function summarizeFound(outcome: OutcomeView): Summary {
  const open = outcome.readings.filter((reading) => reading.belief >= BELIEVABLE && reading.differs_on.length > 0);
  if (!open.length) return summary("good", "A program fits all your demonstrations", null);
  const rules = [...new Set(open.map((reading) => reading.rule))].sort((a, b) => a - b);
  const assets = [...new Set(open.flatMap((reading) => reading.differs_on))].sort();
  const who = `Rule${rules.length > 1 ? "s" : ""} ${listText(rules.map(String))}`;
  return summary("good", "Almost unambiguous", `${who} may select other hulls on ${listText(assets.map(shortName), 3)}.`);
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

