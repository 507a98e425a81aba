// What a person does while a program is learned: learn, choose readings, write the program.
import { api } from "../server/api";
import { perform, sendAfterEdits } from "../store/edits";
import { useProject } from "../store/project";
import { findSeparatingAssets } from "../store/readings";
import { openAsset, openStage, setHighlight, visit } from "../store/workspace";
import type { NearestView, CandidateView } from "../wire";
import { commandsOf, needs } from "./command";

/** Learns now, and takes what is learned in place of a program by hand. */
export const learnNow = (): Promise<unknown> => sendAfterEdits(api.learn);
export const stopLearning = (): Promise<unknown> => api.stopLearning();

/** Answers that a rule means another reading: what it selects where that distinguishes it from the others of the rule. */
export async function chooseReading(reading: CandidateView): Promise<void> {
  setHighlight(null);
  const { rule, extractor } = reading;
  const assets = await findSeparatingAssets(reading);
  const says = await Promise.all(assets.map((asset) => api.select({ asset, rule, extractor })));
  for (const [k, asset] of assets.entries()) {
    await perform({ kind: "answer", rule, asset, select: says[k]?.select ?? [] });
  }
}

export const withdraw = (id: string): Promise<boolean> => perform({ kind: "take-back", id });

/** Makes a text the program, unless it was changed elsewhere since `version`. */
export const writeProgram = (text: string, version: string): Promise<boolean> =>
  perform({ kind: "program", text, version });

/** Opens a demonstrated asset as the rule meets it that has no extractor, with the hulls selected that do not fit. */
export function showNearest({ asset, rule }: NearestView, names: readonly string[]): void {
  visit(asset, rule > 1 ? { kind: "steps", steps: rule - 1 } : { kind: "source" }, names);
}

export function demonstrate(asset: string): void {
  openAsset(asset);
  openStage("demonstrate");
}

const project = useProject.getState;

export const learnCommands = commandsOf("Learn", [
  {
    id: "learn",
    title: "Learn the program",
    keys: ["Ctrl+Enter"],
    words: "synthesize run",
    enabled: needs(
      () => (project().learning ? "The program is being learned." : "Nothing is demonstrated yet."),
      () => !project().learning && project().project.rules.length > 0,
    ),
    run: () => void learnNow(),
  },
  {
    id: "learn-stop",
    title: "Stop learning",
    enabled: needs("Nothing is being learned.", () => project().learning),
    run: () => void stopLearning(),
  },
]);
