// What a check found; a click selects the hulls that it is about.
import { CircleAlert, TriangleAlert } from "lucide-react";
import { ruleTitle, selectInOutput } from "../../store/checks";
import { textIn } from "../../store/units";
import { countText, listText } from "../../store/words";
import { hover, useUnit } from "../../store/workspace";
import type { CheckFinding } from "../../wire";
import css from "./checks.module.css";
import review from "./review.module.css";

const ICONS = { error: CircleAlert, warning: TriangleAlert } as const;
const NAMES = { error: "Error", warning: "Warning" } as const;

export function CheckFindings({ asset, findings }: { asset: string; findings: readonly CheckFinding[] }) {
  if (!findings.length) return null;
  return (
    <ul className={review.findings}>
      {findings.map((finding, k) => (
        <li key={k} data-severity={finding.severity}>
          <Finding asset={asset} finding={finding} remedied={isFirst(findings, k)} />
        </li>
      ))}
    </ul>
  );
}

/** Whether no finding of its rule comes before: the remedy is shown once. */
const isFirst = (findings: readonly CheckFinding[], k: number): boolean =>
  findings.findIndex(({ rule, new: fresh }) => fresh && rule === findings[k]?.rule) === k;

interface FindingProps {
  asset: string;
  finding: CheckFinding;
  /** Whether the remedy is shown, too. */
  remedied: boolean;
}

function Finding({ asset, finding, remedied }: FindingProps) {
  const { rule, engine, severity, remedy, hulls, new: fresh } = finding;
  const text = textIn(finding.text, useUnit());
  const Icon = ICONS[severity];
  const [only] = hulls.length === 1 ? hulls : [];
  const words = (
    <>
      <Icon size={15} aria-label={NAMES[severity]} />
      <span className={css.finding}>
        <span>
          <b title={rule}>{ruleTitle({ rule, engine })}</b>
          {!fresh && <span className={css.dim}> · as before the edit</span>}
        </span>
        <span className={css.words} title={text}>
          {text}
        </span>
        {remedied && <span className={css.dim}>{remedy}</span>}
      </span>
    </>
  );
  if (!hulls.length) return <div className={review.finding}>{words}</div>;
  return (
    <button
      type="button"
      className={review.finding}
      title={`Select ${hulls.length > 4 ? countText(hulls.length, "hull") : listText(hulls)}`}
      onClick={() => selectInOutput(asset, hulls)}
      onPointerEnter={() => hover(only ?? null)}
      onPointerLeave={() => hover(null)}
    >
      {words}
    </button>
  );
}
