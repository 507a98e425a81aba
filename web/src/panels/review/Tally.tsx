// How many results there are of each kind.
import { useMemo } from "react";
import { useProject } from "../../store/project";
import { grouped } from "../../store/reviews";
import type { Card } from "../../wire";
import css from "./review.module.css";

export function Tally() {
  const cards = useProject((state) => state.cards);
  const rows = useMemo(() => tally(Object.values(cards)), [cards]);
  if (!rows.length) return null;
  return (
    <dl className={css.tally}>
      {rows.map(([what, count]) => (
        <div key={what} data-what={what}>
          <dd>{count.toLocaleString("en-GB")}</dd>
          <dt>{what}</dt>
        </div>
      ))}
    </dl>
  );
}

function tally(cards: readonly Card[]): (readonly [string, number])[] {
  const of = (output: Card["output"]) => cards.filter((card) => card.output === output).length;
  const { accepted, flagged } = grouped(cards);
  const rows = [
    ["edited", of("edited")],
    ["unchanged", of("unchanged")],
    ["failed", of("failed")],
    ["flagged", flagged.length],
    ["accepted", accepted.length],
  ] as const;
  return of("none") === cards.length ? [] : rows.filter(([what, count]) => count > 0 || what === "edited" || what === "accepted");
}
