// One result in the list: pictures before and after, numbers, and how it stands.
import { memo, useEffect } from "react";
import { Thumbnail } from "../../pictures/Thumbnail";
import { openAsset, useDesk } from "../../store/desk";
import { byEdit, faultsOf, foundText } from "../../store/faults";
import { staleText } from "../../store/reviews";
import { errorParts, shortName } from "../../store/words";
import { useVerdicts, verdict, verdictKey } from "../../store/verdicts";
import type { Card } from "../../wire";
import css from "./review.module.css";

export const ResultRow = memo(function ResultRow({ card, onOpen }: { card: Card; onOpen: () => void }) {
  const current = useDesk((state) => state.asset === card.asset);
  const written = card.output === "edited" || card.output === "unchanged";
  const open = () => {
    openAsset(card.asset);
    onOpen();
  };
  return (
    <button type="button" className={css.result} aria-current={current} title={card.asset} onClick={open}>
      <span className={css.pictures}>
        <Thumbnail asset={card.asset} of="source" size={68} label="" />
        {written && <Thumbnail asset={card.asset} of="output" size={68} label="" />}
      </span>
      <span className={css.resultText}>
        <strong>{shortName(card.asset)}</strong>
        {written && (
          <span className={css.facts}>
            {card.output === "unchanged" ? `${card.hulls ?? 0} hulls, unchanged` : `${card.hulls ?? 0} → ${card.after ?? 0} hulls`} <Legality card={card} /> <Found card={card} />
          </span>
        )}
        <Line card={card} />
      </span>
    </button>
  );
});

/** The most pressing thing to say of a result. */
function Line({ card }: { card: Card }) {
  if (card.output === "failed" || card.error) return <Failure card={card} />;
  if (card.stale.length) return <span className={css.warn}>not up to date: {staleText(card.stale)}</span>;
  if (card.review === "flagged") return <span className={css.warn}>⚑ {card.note ?? "flagged"}</span>;
  const flag = card.flags[0];
  if (flag) return <span className={css.warn}>⚑ {flag}</span>;
  return card.review === "accepted" ? <span className={css.good}>✓ accepted</span> : null;
}

function Failure({ card }: { card: Card }) {
  const { message, remedy } = errorParts(card.error ?? "failed", card.asset);
  return (
    <>
      <span className={css.bad}>✗ {message}</span>
      {remedy && <span className={css.dim}>{remedy}</span>}
    </>
  );
}

/** What the checks found, where they were made. */
function Found({ card }: { card: Card }) {
  const engine = useDesk((state) => state.checks.engine);
  const found = faultsOf(card, engine);
  if (!found.length) return null;
  return (
    <span className={byEdit(found) ? css.warn : undefined} title={foundText(found)}>
      · ⚠&nbsp;{found.length}
    </span>
  );
}

function Legality({ card }: { card: Card }) {
  const found = useVerdicts((state) => state.verdicts[verdictKey(card)]);
  useEffect(() => {
    // one that cannot be told says nothing here; opening the asset says why
    if (!found) verdict(card).catch(() => undefined);
  }, [card, found]);
  if (!found) return null;
  if (found === "legal") return <span className={css.good}>· legal</span>;
  return found === "illegal" ? <span className={css.bad}>· not legal</span> : <span className={css.warn}>· warnings</span>;
}
