// Long work that a person starts: carrying labels over, applying the program, exporting.
import { api } from "../server/api";
import type { JobRequest, Model } from "../wire";
import { useProject } from "./project";
import { complainedOf } from "./toasts";
import { givenLabels } from "./unsure";

/** Why the program cannot be applied, null where it can. */
export function notApplicable(): string | null {
  const { program, project, order, jobs } = useProject.getState();
  if (!order.length) return "There are no assets yet.";
  if (program.error) return `The program cannot be read: ${program.error}`;
  if (!program.text.trim()) return "There is no program yet: demonstrate the steps, then learn.";
  if (project.problem) return project.problem;
  return jobs.some((job) => job.kind === "apply" && job.state === "running") ? "It is being applied now." : null;
}

/** Why labels cannot be carried over, null where they can. */
export function notCarriable(): string | null {
  const { cards, project, order, jobs } = useProject.getState();
  const { hulls, given } = givenLabels(cards);
  if (jobs.some((job) => job.kind === "propagate" && job.state === "running")) return "It is being done now.";
  if (!order.length) return "There are no assets yet.";
  if (!project.vocabulary.length) return "Say first what the parts are called.";
  if (!given) return "Label the hulls of one asset first.";
  return given === hulls ? "Every hull is labelled by you or a file." : null;
}

/** Begins a job, and gives its id; null where it cannot be begun. */
async function begin(request: JobRequest): Promise<string | null> {
  try {
    return (await api.startJob(request)).id;
  } catch (error) {
    complainedOf(error);
    return null;
  }
}

const start = async (request: JobRequest): Promise<boolean> => (await begin(request)) !== null;

/** Applies the program to all assets, or to some. */
export const applyTo = (assets: readonly string[] | null): Promise<boolean> =>
  start({ kind: "apply", assets: assets && [...assets] });

export const carryOver = (): Promise<boolean> => start({ kind: "propagate" });

/** Finds out what asking the model would send and cost; gives the id of the job. */
export const forecastAsking = (mode: Model["mode"]): Promise<string | null> => begin({ kind: "forecast", mode });

export const askModel = (mode: Model["mode"], max_cost: number | null): Promise<boolean> =>
  start({ kind: "ask", mode, max_cost });

export const exportTo = (folder: string, accepted_only: boolean): Promise<boolean> =>
  start({ kind: "export", folder, accepted_only });

/** Why results cannot be checked, null where they can. */
export function notCheckable(): string | null {
  const { cards, jobs } = useProject.getState();
  if (jobs.some((job) => job.kind === "check" && job.state === "running")) return "They are being checked now.";
  return Object.values(cards).some((card) => card.check !== null) ? null : "Nothing is written yet: apply the program.";
}

export const checkAll = (): Promise<boolean> => start({ kind: "check" });

export function cancelJob(id: string): void {
  api.cancelJob(id).catch(complainedOf);
}
