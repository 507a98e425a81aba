// All results in a list, those first that want a look.
import { useVirtualizer } from "@tanstack/react-virtual";
import { memo, useEffect, useMemo, useRef } from "react";
import { AcceptMany } from "../../family/AcceptMany";
import { Thumbnail } from "../../pictures/Thumbnail";
import { countByEdit, faultsOf, findingsText } from "../../store/checks";
import { flagsOf } from "../../store/goals";
import { useOwnNames, useProject } from "../../store/project";
import {
  getVerdict,
  type Group,
  groupCards,
  GROUPS,
  isWritten,
  listAcceptable,
  staleText,
  useVerdicts,
  verdictKey,
} from "../../store/reviews";
import { errorParts } from "../../store/words";
import { openAsset, useWorkspace } from "../../store/workspace";
import { Name } from "../../ui/Name";
import type { Card } from "../../wire";
import { CheckAll } from "./CheckAll";
import css from "./review.module.css";

const HEADS: Readonly<Record<Group, string>> = {
  failed: "Failed",
  wrong: "Wrong",
  flagged: "Flagged",
  stale: "Not up to date",
  open: "Not reviewed",
  accepted: "Accepted",
  none: "Not applied yet",
  excluded: "Excluded",
};

type Line = { kind: "head"; group: Group; count: number } | { kind: "card"; card: Card };

export function Results({ onOpen }: { onOpen: () => void }) {
  const cards = useProject((state) => state.cards);
  const order = useProject((state) => state.order);
  const inOrder = useMemo(() => order.flatMap((asset) => cards[asset] ?? []), [order, cards]);
  const confidence = useProject((state) => state.confidence);
  const lines = useMemo(() => linesOf(inOrder), [inOrder]);
  return (
    <div className={css.results}>
      <div className={css.family}>
        <CheckAll />
        <AcceptMany assets={listAcceptable(inOrder, confidence)} what="legal and unflagged" tip="Accepts all unreviewed outputs that are up to date, legal, not flagged, and sure enough" />
      </div>
      <List lines={lines} onOpen={onOpen} />
    </div>
  );
}

function List({ lines, onOpen }: { lines: readonly Line[]; onOpen: () => void }) {
  const scroll = useRef<HTMLDivElement>(null);
  const rows = useVirtualizer({
    count: lines.length,
    getScrollElement: () => scroll.current,
    estimateSize: (k) => (lines[k]?.kind === "head" ? 30 : 78),
    getItemKey: (k) => keyOf(lines[k], k),
    overscan: 6,
  });
  return (
    <div ref={scroll} className={css.list} role="list" aria-label="All results">
      <div style={{ height: rows.getTotalSize(), position: "relative" }}>
        {rows.getVirtualItems().map(({ index, key, start }) => {
          const line = lines[index];
          return (
            <div key={key} role="listitem" data-index={index} ref={rows.measureElement} className={css.place} style={{ transform: `translateY(${start}px)` }}>
              {line?.kind === "head" && (
                <h3 className={css.groupHead}>
                  {HEADS[line.group]} <span className={css.dim}>{line.count}</span>
                </h3>
              )}
              {line?.kind === "card" && <ResultRow card={line.card} onOpen={onOpen} />}
            </div>
          );
        })}
      </div>
    </div>
  );
}

function linesOf(cards: readonly Card[]): Line[] {
  const groups = groupCards(cards);
  return GROUPS.flatMap((group) => {
    const rows = groups[group];
    if (!rows.length) return [];
    return [{ kind: "head", group, count: rows.length } as const, ...rows.map((card) => ({ kind: "card", card }) as const)];
  });
}

function keyOf(line: Line | undefined, k: number): string | number {
  if (!line) return k;
  return line.kind === "head" ? line.group : `= ${line.card.asset}`;
}

/** One result in the list: pictures before and after, numbers, and how it stands. */
const ResultRow = memo(function ResultRow({ card, onOpen }: { card: Card; onOpen: () => void }) {
  const current = useWorkspace((state) => state.asset === card.asset);
  const ownName = useOwnNames();
  const written = isWritten(card);
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
        <strong>
          <Name text={card.asset} own={ownName(card.asset)} />
        </strong>
        {written && (
          <span className={css.facts}>
            {card.output === "unchanged" ? `${card.hulls ?? 0} hulls, unchanged` : `${card.hulls ?? 0} → ${card.after ?? 0} hulls`} <Legality card={card} /> <CheckCount card={card} />
          </span>
        )}
        <StateLine card={card} />
      </span>
    </button>
  );
});

/** The most pressing thing to say of a result. */
function StateLine({ card }: { card: Card }) {
  if (card.output === "failed" || card.error) {
    const { message, remedy } = errorParts(card.error ?? "failed", card.asset);
    return (
      <>
        <span className={css.bad}>✗ {message}</span>
        {remedy && <span className={css.dim}>{remedy}</span>}
      </>
    );
  }
  if (card.stale.length) return <span className={css.warn}>not up to date: {staleText(card.stale)}</span>;
  if (card.excluded) return <span className={css.dim}>excluded: {card.excluded}</span>;
  if (card.review === "wrong") return <span className={css.warn}>✗ {card.note ?? "wrong"}</span>;
  const [flag] = flagsOf(card);
  if (flag) return <span className={css.warn}>⚑ {flag}</span>;
  return card.review === "accepted" ? <span className={css.good}>✓ accepted</span> : null;
}

/** What the checks found, where they were made. */
function CheckCount({ card }: { card: Card }) {
  const engine = useWorkspace((state) => state.checks.engine);
  const found = faultsOf(card, engine);
  if (!found.length) return null;
  return (
    <span className={countByEdit(found) ? css.warn : undefined} title={findingsText(found)}>
      · ⚠&nbsp;{found.length}
    </span>
  );
}

function Legality({ card }: { card: Card }) {
  const found = useVerdicts((state) => state.verdicts[verdictKey(card)]);
  useEffect(() => {
    // one that fails says nothing here; opening the asset says why
    if (!found) getVerdict(card).catch(() => undefined);
  }, [card, found]);
  if (!found) return null;
  if (found === "legal") return <span className={css.good}>· legal</span>;
  return found === "illegal" ? <span className={css.bad}>· not legal</span> : <span className={css.warn}>· warnings</span>;
}
