// What a lesson came to, in words, and what a rule reaches; knows neither DOM nor three.js.
import type { ChoiceView, LessonView, ProgramView, Reach, ReadingView, RuleView } from "../wire";
import type { Highlight } from "./desk";
import { among, counted, listed, shortName } from "./words";

/** How learning stands: a title, what more there is to say, and whether that is good. */
export interface Summary {
  mood: "plain" | "good" | "warn" | "bad";
  title: string;
  more: string | null;
}

/** From which belief on another reading is worth a look; the same as in the synthesis. */
const BELIEVABLE = 0.005;

/** assets: how many there are to be learned from. */
export function lessonSummary(lesson: LessonView | null, assets: number): Summary {
  if (!lesson) return summary("plain", "Nothing is demonstrated yet", "Show the steps on an asset; the program comes by itself.");
  switch (lesson.status) {
    case "found":
      return lesson.settled ? settled(lesson.looked_at, assets) : almost(lesson);
    case "ambiguous":
      return summary("warn", "One question is open", "The program does what you showed; your answer decides the rest.");
    case "repair": {
      const labels = counted(lesson.repairs.length, "label");
      return summary("warn", `${labels} may be wrong`, "With that mended, there is a program.");
    }
    case "none":
      return summary("bad", `No program${lesson.nearest ? ` yet: rule ${lesson.nearest.rule} cannot be told` : ""}`, lesson.why);
    case "timeout":
      return summary("warn", `Stopped at rule ${lesson.rules.length + 1}`, "The rules before it are there. Learn again, or show that rule on another asset.");
    case "error":
      return summary("bad", "Learning did not work", lesson.error);
  }
}

function settled(lookedAt: number, assets: number): Summary {
  const all = assets === 1 ? "your one asset" : `your ${counted(assets, "asset")}`;
  const where = lookedAt < assets ? `the ${counted(lookedAt, "asset")} looked at, of ${all}` : all;
  return summary("good", "Settled", `All readings agree on ${where}.`);
}

function almost(lesson: LessonView): Summary {
  const open = lesson.readings.filter((reading) => reading.belief >= BELIEVABLE && reading.differs_on.length > 0);
  if (!open.length) return summary("good", "A program fits all that you showed", null);
  const rules = [...new Set(open.map((reading) => reading.rule))].sort((a, b) => a - b);
  const assets = [...new Set(open.flatMap((reading) => reading.differs_on))].sort();
  const who = `Rule${rules.length > 1 ? "s" : ""} ${listed(rules.map(String))}`;
  return summary("good", "Almost settled", `${who} might mean something else on ${listed(assets.map(shortName), 3)}.`);
}

const summary = (mood: Summary["mood"], title: string, more: string | null): Summary => ({ mood, title, more });

/** What a rule (from 1) selects on all assets, for the thumbnails. */
export function highlightOfRule(reach: Readonly<Record<string, Reach>>, rule: number): Highlight {
  const rows = Object.values(reach).flatMap(({ asset, rules }) => {
    const positions = rules[rule - 1];
    return positions ? [[asset, positions] as const] : [];
  });
  return { what: `rule ${rule}`, assets: Object.fromEntries(rows) };
}

/** On how many assets something is selected, how many hulls in all, and how many assets were looked at for that. */
export interface Spread {
  readonly hulls: number;
  readonly assets: number;
  readonly lookedAt: number;
}

/** counts: hulls that are selected on each asset. */
export function spreadOf(counts: readonly number[], lookedAt = counts.length): Spread {
  const hulls = counts.reduce((sum, count) => sum + count, 0);
  return { hulls, assets: counts.filter((count) => count > 0).length, lookedAt };
}

/** How far a rule (from 1) reaches; null while it is not known. */
export function reachOfRule(reach: Readonly<Record<string, Reach>>, rule: number): Spread | null {
  const rows = Object.values(reach);
  const counts = rows.flatMap(({ rules }) => rules[rule - 1]?.length ?? []);
  return counts.length ? spreadOf(counts, rows.length) : null;
}

/** assets: how many there are. */
export function spreadText({ hulls, assets, lookedAt }: Spread, all: number): string {
  const of = among(lookedAt, all);
  return hulls ? `${counted(hulls, "hull")} on ${counted(assets, "asset")}${of}` : `selects nothing on any asset${of}`;
}

/** The readings of a rule, the one of the program first, then the most believable. */
export function readingsOf(lesson: LessonView | null, rule: RuleView): readonly ReadingView[] {
  const own = extractorOf(rule.text);
  const rows = (lesson?.readings ?? []).filter((reading) => reading.rule === rule.rule);
  const taken = (reading: ReadingView): number => Number(reading.extractor === own);
  return [...rows].sort((a, b) => taken(b) - taken(a) || b.belief - a.belief);
}

/** The extractor of a rule's text; an arrow in a quoted label is no end of it. */
export function extractorOf(rule: string): string {
  const found = /^((?:"(?:[^"\\\n]|\\.)*"|[^"])*?)=>/.exec(rule);
  return (found?.[1] ?? rule).trim();
}

/** Whether what was learned is another program than the accepted one. */
export function learnedDiffers(program: ProgramView, lesson: LessonView | null): boolean {
  return lesson?.program != null && lesson.program.trim() !== program.text.trim();
}

/** Names that are in some of the sets but not in all. */
export function differing(sets: readonly (readonly string[])[]): string[] {
  const names = new Set(sets.flat());
  return [...names].filter((name) => !sets.every((set) => set.includes(name)));
}

/** What a choice of a question takes; a later one by how it differs from the first, where that says it shorter. */
export function choiceText(choices: readonly ChoiceView[], k: number): string {
  const own = choices[k]?.select ?? [];
  const first = choices[0]?.select ?? [];
  if (!own.length) return "No hull";
  const more = own.filter((name) => !first.includes(name));
  const less = first.filter((name) => !own.includes(name));
  const count = counted(own.length, "hull");
  if (k === 0 || more.length + less.length >= own.length) return count;
  const parts = [more.length ? ` and ${listed(more)}` : "", less.length ? ` without ${listed(less)}` : ""];
  return `${count}: those of 1${parts.filter(Boolean).join(",")}`;
}
