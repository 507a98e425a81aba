// The latest job of a kind.
import { useProject } from "../../store/project";
import type { Job } from "../../wire";

export function useJob(kind: Job["kind"]): Job | null {
  return useProject((state) => state.jobs.findLast((job) => job.kind === kind) ?? null);
}
