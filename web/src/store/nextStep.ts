// The next step as the page shows it: the server's sentence, or how far the job is that does what it says.
import type { Job, NextStep } from "../wire";
import type { ProjectState } from "./project";
import { useProject } from "./project";
import { STAGE_OF, useWorkspace } from "./workspace";

/** Jobs that do what a step says. */
const JOBS: Partial<Record<NextStep["kind"], readonly Job["kind"][]>> = {
  wait: ["read"],
  decompose: ["decompose"],
  "label-all": ["label"],
  label: ["label"],
  "check-labels": ["label"],
  apply: ["apply"],
  export: ["export"],
};

/** The job that does what the next step says, null where none is running. */
export function jobOfNext({ project: { next }, jobs }: Pick<ProjectState, "project" | "jobs">): Job | null {
  return jobs.findLast(({ kind, state }) => state === "running" && JOBS[next.kind]?.includes(kind)) ?? null;
}

/** `Decomposing 9 assets: 3 of 9`; without a job that runs, the sentence of the step. */
export function nextText(state: Pick<ProjectState, "project" | "jobs">): string {
  const job = jobOfNext(state);
  if (!job) return state.project.next.text;
  return job.total ? `${job.title}: ${job.done} of ${job.total}` : `${job.title}…`;
}

/** Whether there is nothing to go to or to do: one is there, or has to wait. */
export function useIsThere(): boolean {
  const { kind, asset } = useProject((state) => state.project.next);
  const running = useProject((state) => jobOfNext(state) !== null);
  const there = useWorkspace((workspace) => workspace.stage === STAGE_OF[kind] && (asset === null || workspace.asset === asset));
  return kind === "wait" || (there && (running || ["label", "demonstrate", "learn", "fix-program", "correct"].includes(kind)));
}
