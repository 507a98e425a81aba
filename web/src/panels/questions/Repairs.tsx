// Labels that are probably wrong, each as a card to accept or reject.
import { ArrowRight, Check, Crosshair, X } from "lucide-react";
import { useMemo } from "react";
import { answerRepair, showRepair } from "../../commands/learn";
import { useProject } from "../../store/project";
import { confidenceText, countText, shortName } from "../../store/words";
import { Button } from "../../ui/Button";
import { Section, Swatch } from "../../ui/Section";
import type { RepairView } from "../../wire";
import { HullsPicture, useRulePicture } from "../learn/RulePicture";
import css from "../learn/learn.module.css";

export function Repairs({ repairs }: { repairs: readonly RepairView[] }) {
  return (
    <Section title="Labels that may be wrong" aside={countText(repairs.length, "label")}>
      {repairs.map((repair) => (
        <RepairCard key={repair.id} repair={repair} />
      ))}
    </Section>
  );
}

/** One label that is probably wrong: the hull, what it is labelled, and what it looks like. */
function RepairCard({ repair }: { repair: RepairView }) {
  const { asset, hull, was, to, belief, why } = repair;
  const hulls = useMemo(() => [hull], [hull]);
  const picture = useRulePicture(asset, 1, hulls);
  return (
    <article className={css.repair} aria-label={`${hull} of ${asset}`}>
      <div className={css.repairPicture}>
        <HullsPicture picture={picture} hulls={hulls} label={`${shortName(asset)} with ${hull} highlighted`} />
      </div>
      <div className={css.repairText}>
        <p>
          <strong>{hull}</strong> of <strong title={asset}>{shortName(asset)}</strong> looks like <strong>{to}</strong>; it{" "}
          {was === null ? "has no label." : `is labelled ${was}.`}
        </p>
        <p className={css.change}>
          <Label name={was} /> <ArrowRight size={14} aria-label="to" /> <Label name={to} />
          {belief < 1 && (
            <span className={css.dim} title={`${Math.min(99, Math.round(100 * belief))} %`}>
              {confidenceText(belief)}
            </span>
          )}
        </p>
        <p className={css.dim}>{why}</p>
      </div>
      <div className={css.row}>
        <Button look="primary" icon={Check} onClick={() => void answerRepair(repair, true)}>
          Accept
        </Button>
        <Button icon={X} tip="The label is right; this repair is not proposed again" onClick={() => void answerRepair(repair, false)}>
          Reject
        </Button>
        <Button look="quiet" icon={Crosshair} tip="Open the asset with this hull selected" onClick={() => showRepair(repair)}>
          Show
        </Button>
      </div>
    </article>
  );
}

function Label({ name }: { name: string | null }) {
  const color = useProject((state) => state.project.vocabulary.find((label) => label.name === name)?.color);
  return (
    <span className={css.label}>
      <Swatch color={color ?? "var(--hull-unlabelled)"} />
      {name ?? "no label"}
    </span>
  );
}
