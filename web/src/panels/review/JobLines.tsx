// What became of each asset in a job.
import { openAsset } from "../../store/desk";
import { shortName } from "../../store/words";
import type { JobLine } from "../../wire";
import css from "./review.module.css";

const SIGNS: Readonly<Record<JobLine["status"], string>> = { done: "✓", edited: "✓", unchanged: "=", failed: "✗", skipped: "–" };

export function JobLines({ lines }: { lines: readonly JobLine[] }) {
  if (!lines.length) return null;
  return (
    <ul className={css.jobLines} aria-label="What became of each asset">
      {lines.map((line) => (
        <li key={line.asset}>
          <button type="button" data-status={line.status} title={`Open ${line.asset}`} onClick={() => openAsset(line.asset)}>
            <span aria-hidden>{SIGNS[line.status]}</span>
            <strong>{shortName(line.asset)}</strong>
            <span>{line.text || line.status}</span>
          </button>
        </li>
      ))}
    </ul>
  );
}
