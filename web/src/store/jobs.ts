// Long work that a person starts: labelling, applying the program, checking, exporting.
import { api } from "../server/api";
import type { DecomposeOptions, Job, JobLine, JobRequest } from "../wire";
import { pendingEdits, perform, sendAfterEdits } from "./edits";
import { byAsset } from "./hullPlaces";
import { endStroke } from "./labels";
import { useLabelSources } from "./labelSources";
import { labelProgress } from "./labelWalk";
import { useRebuildChoice } from "./newAssets";
import { useProject } from "./project";
import { countText, durationText } from "./words";

export const isRunning = (jobs: readonly Job[], kind: Job["kind"]): boolean => jobs.some((job) => job.kind === kind && job.state === "running");

/** Why the program cannot be applied, null where it can. */
export function whyNotApply(): string | null {
  const { program, project, order, jobs } = useProject.getState();
  if (!order.length) return "There are no assets yet.";
  if (program.error) return `The program cannot be read: ${program.error}`;
  if (!program.text.trim()) return "There is no program yet: demonstrate the steps, then learn.";
  if (project.problem) return project.problem;
  return isRunning(jobs, "apply") ? "The program is being applied now." : null;
}

/** Why not all hulls can be labelled, null where they can. */
export function whyNotLabel(): string | null {
  const { cards, project, order, jobs } = useProject.getState();
  const { files, names } = useLabelSources.getState();
  const { hulls, labelled, given } = labelProgress(cards);
  if (isRunning(jobs, "label")) return "The hulls are being labelled now.";
  if (!order.length) return "There are no assets yet.";
  if (files || names) return null;
  if (!project.vocabulary.length) return "Type the names of the labels first.";
  if (!labelled) return "Label the hulls of one asset first.";
  return given === hulls ? "Every label was given by you, a file or a name." : null;
}

/** Ends the stroke in hand, and waits until all edits are saved and shown. */
export async function saveEdits(): Promise<void> {
  endStroke();
  await pendingEdits();
}

/** Begins a job once the edits before it are saved; whether it could be begun. */
const startJob = async (request: JobRequest): Promise<boolean> => (await beginJob(request)) !== null;

/** The same; gives its id, null where it could not be begun. */
async function beginJob(request: JobRequest): Promise<string | null> {
  endStroke();
  let id: string | null = null;
  await sendAfterEdits(async () => {
    id = (await api.startJob(request)).id;
  });
  return id;
}

const applyJob = (assets: readonly string[] | null): JobRequest => ({
  kind: "apply",
  assets: assets && [...assets],
  rebuild: useRebuildChoice.getState().rebuild,
});

/** Applies the program to all assets, or to some; those that are new are prepared before. */
export const applyTo = (assets: readonly string[] | null): Promise<boolean> => startJob(applyJob(assets));

export const labelAll = (): Promise<boolean> => startJob({ kind: "label" });

/** Why hulls that span parts cannot be looked for, null where they can. */
export function whyNotRebuild(): string | null {
  const { cards, order, jobs } = useProject.getState();
  if (isRunning(jobs, "rebuild")) return "They are being looked for now.";
  if (!order.length) return "There are no assets yet.";
  const isLabelled = Object.values(cards).some((card) => card.labels.some((label) => label >= 0));
  return isLabelled ? null : "Label the hulls of one or two assets first.";
}

/** Finds the hulls of all assets that span parts. */
export const findSpanning = (): Promise<boolean> => startJob({ kind: "rebuild" });

/** Rebuilds bodies in which hulls were found to span parts; every: whether they are all that were found. */
export function rebuildBodies(found: readonly JobLine[], every: boolean): Promise<boolean> {
  return startJob({ kind: "rebuild", bodies: byLine(found, ({ body }) => (body === null ? [] : [body])), every });
}

/** Says of hulls that were found that they span no parts, so that they are not found again. */
export const dismissSpanning = (found: readonly JobLine[]): Promise<boolean> =>
  perform({ kind: "dismiss-spanning", hulls: byLine(found, ({ hulls }) => hulls) });

const byLine = (lines: readonly JobLine[], namesOf: (line: JobLine) => readonly string[]): Record<string, string[]> =>
  Object.fromEntries(byAsset(lines.flatMap((line) => namesOf(line).map((hull) => ({ asset: line.asset, hull })))));

export const exportTo = (folder: string, signed_only: boolean): Promise<boolean> =>
  startJob({ kind: "export", folder, signed_only });

/** Why results cannot be checked, null where they can. */
export function whyNotCheck(): string | null {
  const { cards, jobs } = useProject.getState();
  if (isRunning(jobs, "check")) return "They are being checked now.";
  return Object.values(cards).some((card) => card.check !== null) ? null : "Nothing is written yet: apply the program.";
}

export const checkAll = (): Promise<boolean> => startJob({ kind: "check" });

/** Tries a goal that is not kept on all assets. */
export const tryGoal = (text: string): Promise<boolean> => startJob({ kind: "check", goal: text });

export const cancelJob = (id: string): Promise<Job> => api.cancelJob(id);

/** The latest job of a kind. */
export function useJob(kind: Job["kind"]): Job | null {
  return useProject((state) => state.jobs.findLast((job) => job.kind === kind) ?? null);
}

export const makeHulls = (assets: readonly string[], options: DecomposeOptions): void => void startJob({ kind: "decompose", assets: [...assets], ...options });

/** Makes the hulls of one asset and keeps none; the id of the job, null where it could not be begun. */
export const tryHulls = (asset: string, assets: string[], options: DecomposeOptions): Promise<string | null> => beginJob({ kind: "preview", asset, assets, ...options });

/** How far a job is: `23 of 61 pieces, about 40 s left`. */
export function progressText({ kind, done, total, left }: Job, unit = kind === "decompose" || kind === "preview" ? "piece" : ""): string {
  const all = unit ? countText(total, unit) : total.toLocaleString("en-GB");
  return `${done.toLocaleString("en-GB")} of ${all}${left === null || left === undefined || left < 1 ? "" : `, about ${durationText(left)} left`}`;
}

/** Whether an asset is waiting for hulls to be made. */
export const useIsDecomposing = () => useProject(({ jobs }) => isRunning(jobs, "decompose"));
