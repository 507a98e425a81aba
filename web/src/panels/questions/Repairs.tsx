// Labels that are probably wrong, each as a card to accept or reject.
import { ArrowRight, Check, Crosshair, X } from "lucide-react";
import { useMemo } from "react";
import { answerRepair, showRepair } from "../../commands/learn";
import { useProject } from "../../store/project";
import { confidenceText, countText, shortName } from "../../store/words";
import { Section, Swatch } from "../../ui/Section";
import type { RepairView } from "../../wire";
import { HullsPicture, useRulePicture } from "../learn/RulePicture";
import css from "../learn/learn.module.css";
import { useCardKeys } from "./cardKeys";
import { Reply } from "./Replies";

/** withKeys: whether the first one is the card that keys are about. */
export function Repairs({ repairs, withKeys }: { repairs: readonly RepairView[]; withKeys: boolean }) {
  return (
    <Section title="Labels that may be wrong" aside={countText(repairs.length, "label")}>
      {repairs.map((repair, k) => (
        <RepairCard key={repair.id} repair={repair} withKeys={withKeys && k === 0} />
      ))}
    </Section>
  );
}

/** One label that is probably wrong: the hull, what it is labelled, and what it looks like. */
function RepairCard({ repair, withKeys }: { repair: RepairView; withKeys: boolean }) {
  const { asset, hull, was, to, belief, why } = repair;
  const hulls = useMemo(() => [hull], [hull]);
  const picture = useRulePicture(asset, 1, hulls);
  const [accept, reject, show] = [() => void answerRepair(repair, true), () => void answerRepair(repair, false), () => showRepair(repair)];
  const doing = useCardKeys(withKeys ? { accept, reject, show } : null);
  const key = (name: string) => (withKeys ? { keyName: name } : {});
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
        <Reply {...key("Y")} look="primary" icon={Check} onClick={doing(accept)}>
          Accept
        </Reply>
        <Reply {...key("N")} icon={X} tip="The label is right; this repair is not proposed again" onClick={doing(reject)}>
          Reject
        </Reply>
        <Reply {...key("S")} look="quiet" icon={Crosshair} tip="Open the asset with this hull selected" onClick={doing(show)}>
          Show
        </Reply>
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
