// The grid of cards; only those in sight are there, so that a thousand scroll as well as ten.
import { useVirtualizer } from "@tanstack/react-virtual";
import { type KeyboardEvent, useEffect, useLayoutEffect, useRef, useState } from "react";
import { openAsset, setFilters, useDesk } from "../store/desk";
import { setLayout } from "../store/layout";
import { Button } from "../ui/Button";
import { Card, cardId } from "./Card";
import css from "./family.module.css";
import { useShown } from "./useShown";

const GAP = 8;
const WORDS = 44; // pixels below the picture

/** least: width of a card [px]; large: before → after is told beside the picture. */
export function Cards({ least, large = false }: { least: number; large?: boolean }) {
  const box = useRef<HTMLDivElement>(null);
  const shown = useShown();
  const asset = useDesk((desk) => desk.asset);
  const width = useWidth(box);
  const columns = Math.max(1, Math.floor((width - GAP) / (least + GAP)));
  const card = Math.floor((width - GAP) / columns - GAP);
  const rows = useVirtualizer({
    count: Math.ceil(shown.length / columns),
    getScrollElement: () => box.current,
    estimateSize: () => Math.round(card * 0.75) + WORDS + GAP,
    overscan: 2,
    paddingStart: 2,
    paddingEnd: GAP,
  });
  useEffect(() => rows.measure(), [rows, card]);
  useFollowed(asset, shown, columns, (row) => rows.scrollToIndex(row, { align: "auto" }));
  if (shown.length === 0) return <NoMatch />;
  return (
    <div
      ref={box}
      className={css.cards}
      role="listbox"
      aria-label="Assets"
      tabIndex={0}
      aria-activedescendant={asset === null ? undefined : cardId(asset)}
      data-first
      data-tab-assets
      data-testid="family"
      onKeyDown={(event) => moved(event, shown, columns)}
    >
      <div className={css.rows} style={{ height: rows.getTotalSize() }} role="presentation">
        {rows.getVirtualItems().map(({ index, start }) => (
          <div key={index} className={css.row} style={{ transform: `translateY(${start}px)`, gap: GAP }} role="presentation">
            {shown.slice(index * columns, (index + 1) * columns).map((one, k) => (
              <Card key={one} asset={one} width={card} place={index * columns + k} of={shown.length} large={large} />
            ))}
          </div>
        ))}
      </div>
    </div>
  );
}

/** The width inside an element, as it changes. */
function useWidth(box: React.RefObject<HTMLElement | null>): number {
  const [width, setWidth] = useState(264);
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const measure = () => setWidth(element.clientWidth);
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    measure();
    return () => observer.disconnect();
  });
  return width;
}

/** Scrolls to the asset that is opened, wherever that was done. */
function useFollowed(
  asset: string | null,
  shown: readonly string[],
  columns: number,
  scrollTo: (row: number) => void,
): void {
  const latest = useRef({ shown, columns, scrollTo });
  useLayoutEffect(() => {
    latest.current = { shown, columns, scrollTo };
  });
  useEffect(() => {
    const { shown: all, columns: across, scrollTo: go } = latest.current;
    const at = asset === null ? -1 : all.indexOf(asset);
    if (at >= 0) go(Math.floor(at / across));
  }, [asset]);
}

/** Arrow keys go to the assets beside, above and below; Enter shows the one that is open in the view. */
function moved(event: KeyboardEvent, shown: readonly string[], columns: number): void {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const { asset } = useDesk.getState();
  const here = asset === null ? -1 : shown.indexOf(asset);
  const page = columns * 4;
  const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns, PageUp: -page, PageDown: page };
  const end = { Home: 0, End: shown.length - 1 }[event.key];
  const step = (by as Record<string, number>)[event.key];
  if (event.key === "Enter") setLayout({ gallery: false });
  else if (end === undefined && step === undefined) return;
  event.preventDefault();
  const to = end ?? Math.min(Math.max(here + (step ?? 0), 0), shown.length - 1);
  if (event.key !== "Enter" && shown[to] !== undefined) openAsset(shown[to]);
}

function NoMatch() {
  return (
    <div className={css.noMatch}>
      <p>No asset matches.</p>
      <Button onClick={() => setFilters({ search: "", only: [] })}>Clear filters</Button>
    </div>
  );
}
