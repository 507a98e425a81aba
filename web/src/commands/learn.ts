// What a person does while a program is learned: learn, answer, repair labels, write the program.
import { api } from "../server/api";
import { perform } from "../store/edits";
import { useProject } from "../store/project";
import { differing, findSeparatingAssets } from "../store/readings";
import { reportError } from "../store/toasts";
import { openAsset, openStage, setHighlight, useWorkspace, visit } from "../store/workspace";
import type { NearestView, QuestionView, ReadingView, RepairView } from "../wire";
import type { Command } from "./command";

/** Learns now, and takes what is learned in place of a program by hand. */
export const learnNow = (): Promise<unknown> => api.learn().catch(reportError);
export const stopLearning = (): Promise<unknown> => api.stopLearning().catch(reportError);

/** Answers a question with one of its choices, counted from 0, or with neither. */
export function answer(question: QuestionView, choice: number | null): Promise<boolean> {
  setHighlight(null);
  const { rule, asset, choices } = question;
  const select = choice === null ? null : (choices[choice]?.select ?? []);
  const refused = choice === null ? choices.map((other) => other.select) : [];
  return perform({ kind: "answer", rule, asset, select, refused });
}

/** Answers that a rule means another reading: what it selects where that distinguishes it from the others of the rule. */
export async function chooseReading(reading: ReadingView): Promise<void> {
  setHighlight(null);
  const question = useProject.getState().outcome?.question;
  const chosen = question?.choices.findIndex((choice) => choice.reading === reading.id) ?? -1;
  if (question && chosen >= 0) return void (await answer(question, chosen));
  const { rule, extractor } = reading;
  try {
    const assets = await findSeparatingAssets(reading);
    const says = await Promise.all(assets.map((asset) => api.select({ asset, rule, extractor })));
    for (const [k, asset] of assets.entries()) {
      await perform({ kind: "answer", rule, asset, select: says[k]?.select ?? [] });
    }
  } catch (error) {
    reportError(error);
  }
}

export function answerRepair({ asset, hull, was, to }: RepairView, accept: boolean): Promise<boolean> {
  setHighlight(null);
  return perform({ kind: "repair", asset, hull, was, to, accept });
}

export const withdraw = (id: string): Promise<boolean> => perform({ kind: "take-back", id });
export const orientBy = (text: string): Promise<boolean> => perform({ kind: "orient", text });

/** Makes a text the program, unless it was changed elsewhere since `version`. */
export const writeProgram = (text: string, version: string): Promise<boolean> =>
  perform({ kind: "program", text, version });

/** Opens the asset of a repair with its hull selected. */
export const showRepair = ({ asset, hull }: RepairView): void => visit(asset, { kind: "source" }, [hull]);

/** Opens the asset of a question with the hulls selected on which the choices differ. */
export function showQuestion({ asset, choices }: QuestionView): void {
  visit(asset, { kind: "source" }, differing(choices.map((choice) => choice.select)));
}

/** Opens a demonstrated asset as the rule meets it that has no extractor, with the hulls selected that do not fit. */
export function showNearest({ asset, rule }: NearestView, names: readonly string[]): void {
  visit(asset, rule > 1 ? { kind: "steps", steps: rule - 1 } : { kind: "source" }, names);
}

export function demonstrate(asset: string): void {
  openAsset(asset);
  openStage("demonstrate");
}

const project = useProject.getState;

export const learnCommands: readonly Command[] = [
  {
    id: "learn",
    title: "Learn the program",
    group: "Learn",
    keys: ["Ctrl+Enter"],
    enabled: () => !project().learning && project().project.rules.length > 0,
    run: () => void learnNow(),
  },
  {
    id: "learn-stop",
    title: "Stop learning",
    group: "Learn",
    keys: [],
    enabled: () => project().learning,
    run: () => void stopLearning(),
  },
  {
    id: "learn-hint",
    title: "Demonstrate the asset that helps most",
    group: "Learn",
    keys: [],
    enabled: () => project().outcome?.hint != null,
    run: () => {
      const hint = project().outcome?.hint;
      if (hint) demonstrate(hint.asset);
    },
  },
  {
    id: "learn-question",
    title: "Show the hulls that the question is about",
    group: "Learn",
    keys: [],
    enabled: () => project().outcome?.question != null && useWorkspace.getState().stage === "learn",
    run: () => {
      const question = project().outcome?.question;
      if (question) showQuestion(question);
    },
  },
];
