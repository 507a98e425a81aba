// The next step as the page shows it: the server's sentence, with how far the job is that it names.
import type { Job } from "../wire";
import { ownPartsOf, sentenceOf } from "./commonParts";
import { type ProjectState, useProject } from "./project";
import { STAGE_OF, useWorkspace } from "./workspace";

type State = Pick<ProjectState, "project" | "jobs" | "order">;

/** The job that the next step names, until it is over and another step is next; null where there is none. */
export const jobOfNext = ({ project: { next }, jobs }: Pick<State, "project" | "jobs">): Job | null => jobs.findLast(({ title }) => title === next.text) ?? null;

/** `Decomposing 9 assets: 3 of 9`; without a job, the sentence of the step. */
export function nextText(state: State): string {
  const { text, asset } = state.project.next;
  const job = jobOfNext(state);
  if (!job) return sentenceOf(text, asset === null ? [] : [asset], ownPartsOf(state.order));
  const doing = job.doing && job.doing !== text.toLowerCase() ? `${text}, ${job.doing}` : text;
  return job.done < job.total ? `${doing}: ${job.done} of ${job.total}` : `${doing}…`;
}

/** Whether there is nothing to go to or to do: one is there, or has to wait. */
export function useIsThere(): boolean {
  const { kind, asset } = useProject((state) => state.project.next);
  const running = useProject((state) => jobOfNext(state) !== null);
  const there = useWorkspace((workspace) => workspace.stage === STAGE_OF[kind] && (asset === null || workspace.asset === asset));
  return kind === "wait" || (there && (running || ["label", "demonstrate", "learn", "fix-program", "correct"].includes(kind)));
}
