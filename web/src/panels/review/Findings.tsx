// What the check of legality says of the edited asset.
import { CircleAlert, CircleCheck, Info, TriangleAlert } from "lucide-react";
import { hover, select } from "../../store/desk";
import { verdictOf } from "../../store/reviews";
import { counted } from "../../store/words";
import type { EditedHeader, FindingView } from "../../wire";
import { Section } from "../../ui/Section";
import css from "./review.module.css";

const ICONS = { error: CircleAlert, warning: TriangleAlert, note: Info } as const;
const NAMES = { error: "Error", warning: "Warning", note: "Note" } as const;

export function Findings({ edit }: { edit: EditedHeader }) {
  const verdict = verdictOf(edit);
  return (
    <Section title="Legality" aside={edit.findings.length ? counted(edit.findings.length, "finding") : null}>
      {verdict === "legal" && (
        <p className={css.legal}>
          <CircleCheck size={15} aria-hidden /> All hulls are convex, closed and in order.
        </p>
      )}
      <ul className={css.findings}>
        {edit.findings.map((finding, k) => (
          <Finding key={k} finding={finding} />
        ))}
      </ul>
    </Section>
  );
}

function Finding({ finding: { severity, text, hull } }: { finding: FindingView }) {
  const Icon = ICONS[severity];
  const words = (
    <>
      <Icon size={15} aria-label={NAMES[severity]} /> <span>{text}</span>
    </>
  );
  return (
    <li data-severity={severity}>
      {hull === null ? (
        <div className={css.finding}>{words}</div>
      ) : (
        <button
          type="button"
          className={css.finding}
          title={`Select ${hull}`}
          onClick={() => select([hull])}
          onPointerEnter={() => hover(hull)}
          onPointerLeave={() => hover(null)}
        >
          {words}
        </button>
      )}
    </li>
  );
}
