// Progress of a job with its rate, and a button that stops it.
import { Square } from "lucide-react";
import { useState } from "react";
import { cancelJob } from "../../store/jobs";
import { rateOf } from "../../store/reviews";
import { counted } from "../../store/words";
import type { Job } from "../../wire";
import { Button } from "../../ui/Button";
import css from "./review.module.css";

export function JobProgress({ job, unit }: { job: Job; unit: string }) {
  const [first] = useState(() => ({ done: job.done, at: performance.now() }));
  const rate = rateOf(first, job.done, performance.now());
  return (
    <div className={css.job}>
      <div className={css.split}>
        <span role="status">
          {job.done.toLocaleString("en-GB")} of {counted(job.total, unit)}
          {rate !== null && <span className={css.dim}> · {rate < 10 ? rate.toFixed(1) : Math.round(rate)} a second</span>}
        </span>
        <Button icon={Square} onClick={() => cancelJob(job.id)}>
          Stop
        </Button>
      </div>
      <progress value={job.done} max={Math.max(1, job.total)} aria-label={job.title} />
    </div>
  );
}
