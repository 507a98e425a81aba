// All results in a list, those first that want a look.
import { useVirtualizer } from "@tanstack/react-virtual";
import { CheckCheck } from "lucide-react";
import { useMemo, useRef, useState } from "react";
import { acceptLegal } from "../../commands/reviewing";
import { useProject } from "../../store/project";
import { acceptable, grouped, type Group, GROUPS } from "../../store/reviews";
import type { Card } from "../../wire";
import { Button } from "../../ui/Button";
import { CheckAll } from "./checks/CheckAll";
import { ResultRow } from "./ResultRow";
import css from "./review.module.css";

const HEADS: Readonly<Record<Group, string>> = {
  failed: "Failed",
  flagged: "Flagged",
  stale: "Not up to date",
  telling: "Look at these first",
  open: "Not reviewed",
  accepted: "Accepted",
  none: "Not applied yet",
};

type Line = { kind: "head"; group: Group; count: number } | { kind: "card"; card: Card };

export function Results({ onOpen }: { onOpen: () => void }) {
  const cards = useProject((state) => state.cards);
  const order = useProject((state) => state.order);
  const inOrder = useMemo(() => order.flatMap((asset) => cards[asset] ?? []), [order, cards]);
  const sample = useProject((state) => state.lesson?.sample);
  const lines = useMemo(() => linesOf(inOrder, sample ?? []), [inOrder, sample]);
  return (
    <div className={css.results}>
      <div className={css.family}>
        <CheckAll />
        <AcceptLegal count={acceptable(inOrder).length} />
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
              {line?.kind === "head" && <Head line={line} />}
              {line?.kind === "card" && <ResultRow card={line.card} onOpen={onOpen} />}
            </div>
          );
        })}
      </div>
    </div>
  );
}

function Head({ line }: { line: Line & { kind: "head" } }) {
  return (
    <h4 className={css.groupHead}>
      {HEADS[line.group]} <span className={css.dim}>{line.count}</span>
    </h4>
  );
}

function AcceptLegal({ count }: { count: number }) {
  const [progress, setProgress] = useState<{ done: number; total: number } | null>(null);
  if (!count && !progress) return null;
  const run = () => void acceptLegal((done, total) => setProgress({ done, total })).finally(() => setProgress(null));
  return (
    <Button
      icon={CheckCheck}
      disabled={progress !== null}
      tip="Accepts all outputs that are up to date, without a flag, and not illegal; nobody reviewed them yet"
      onClick={run}
    >
      {progress ? `Checking ${progress.done} of ${progress.total}…` : `Accept all legal and unflagged (${count})`}
    </Button>
  );
}

function linesOf(cards: readonly Card[], sample: readonly string[]): Line[] {
  const groups = grouped(cards, sample);
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
