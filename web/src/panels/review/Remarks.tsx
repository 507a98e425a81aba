// What must be known about an output: why it failed, that it is not up to date, what was left out.
import { RotateCw } from "lucide-react";
import { applyTo, notApplicable } from "../../store/jobs";
import { useProject } from "../../store/project";
import { staleText } from "../../store/reviews";
import { errorParts } from "../../store/words";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import css from "./review.module.css";

export function Remarks({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  if (!card || (!card.error && !card.stale.length && !card.flags.length)) return null;
  return (
    <div className={css.remarks}>
      {card.error && <Failure error={card.error} asset={asset} />}
      {card.stale.length > 0 && <Stale asset={asset} reasons={card.stale} />}
      {card.flags.map((flag) => (
        <Note key={flag} mood="warn">
          ⚑ {flag}
        </Note>
      ))}
    </div>
  );
}

function Failure({ error, asset }: { error: string; asset: string }) {
  const { message, remedy } = errorParts(error, asset);
  return (
    <Note mood="bad">
      {message}
      {remedy && <p className={css.remedy}>{remedy}</p>}
    </Note>
  );
}

function Stale({ asset, reasons }: { asset: string; reasons: readonly string[] }) {
  const blocked = useProject(notApplicable);
  return (
    <Note mood="warn">
      <div className={css.split}>
        <span>Not up to date: {staleText(reasons)}.</span>
        <Button icon={RotateCw} disabled={blocked !== null} onClick={() => void applyTo([asset])}>
          Apply here
        </Button>
      </div>
    </Note>
  );
}
