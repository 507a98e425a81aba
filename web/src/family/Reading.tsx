// How far the reading of the assets is.
import { useProject } from "../store/project";
import css from "./family.module.css";

export function Reading() {
  const job = useProject((state) => state.jobs.find((one) => one.kind === "read" && one.state === "running"));
  if (!job) return null;
  return (
    <div className={css.reading} role="status">
      <span>
        {job.title} {job.total > 0 && `${job.done} of ${job.total}`}
      </span>
      <progress value={job.total ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </div>
  );
}
