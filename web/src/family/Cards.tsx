// The grid of cards; only those in sight are there, so that a thousand scroll as well as ten.
import { useVirtualizer, type Virtualizer } from "@tanstack/react-virtual";
import { type KeyboardEvent, type RefObject, useEffect, useEffectEvent, useLayoutEffect, useMemo, useRef, useState } from "react";
import { wrapName } from "../store/commonParts";
import { useShown } from "../store/family";
import { useOwnNames, useProject } from "../store/project";
import { groupOf } from "../store/reviews";
import { extendSheet } from "../store/sheet";
import { openAsset, setFilters, setLayout, useLayout, useWorkspace } from "../store/workspace";
import { Button } from "../ui/Button";
import { AcceptMany } from "./AcceptMany";
import { Card, cardId } from "./Card";
import css from "./family.module.css";

const GAP = 8;
/** Pixels below the picture, where names take one line or two, and of a letter of a name. */
const [WORDS, LINE, LETTER] = [44, 16, 6.5];

/** The least width of a card [px], in the column and in place of the view. */
const WIDTHS = {
  small: { column: 76, large: 144 },
  middle: { column: 112, large: 216 },
  large: { column: 200, large: 340 },
} as const;

/** large: in place of the view, where the picture tells whether it is of before or after. */
export function Cards({ large }: { large: boolean }) {
  const size = useLayout((layout) => layout.thumbnails);
  const box = useRef<HTMLDivElement>(null);
  const shown = useShown();
  const asset = useWorkspace((workspace) => workspace.asset);
  const stage = useWorkspace((workspace) => workspace.stage);
  const width = useWidth(box);
  // larger where there is much room
  const least = WIDTHS[size][large ? "large" : "column"];
  const wished = large ? Math.max(least, width / (size === "small" ? 14 : 10)) : least;
  const columns = Math.max(1, Math.floor((width - GAP) / (wished + GAP)));
  const card = Math.floor((width - GAP) / columns - GAP);
  const letters = Math.floor((card - 18) / LETTER);
  const ownName = useOwnNames();
  const lines = useMemo(() => (shown.some((one) => ownName(one).length > letters) ? 2 : 1), [shown, ownName, letters]);
  const words = WORDS + (lines - 1) * LINE;
  const rows = useVirtualizer({
    count: Math.ceil(shown.length / columns),
    getScrollElement: () => box.current,
    estimateSize: () => Math.round(card * 0.75) + words + GAP,
    overscan: 2,
    paddingStart: 2,
    paddingEnd: GAP,
  });
  useEffect(() => rows.measure(), [rows, card, words]);
  useScrollToOpen(asset, size, shown, columns, (row) => rows.scrollToIndex(row, { align: "auto" }));
  if (shown.length === 0) {
    return (
      <div ref={box} className={css.cards}>
        <div className={css.noMatch}>
          <p>No asset matches.</p>
          <Button onClick={() => setFilters({ search: "", only: [] })}>Clear filters</Button>
        </div>
      </div>
    );
  }
  return (
    <>
      {large && stage === "review" && <AcceptInSight assets={listInSight(rows).flatMap((row) => shown.slice(row * columns, (row + 1) * columns))} />}
      <div
        ref={box}
        className={css.cards}
        role="listbox"
        aria-label="Assets"
        aria-multiselectable={stage === "label" || undefined}
        tabIndex={0}
        aria-activedescendant={asset === null ? undefined : cardId(asset)}
        data-first
        data-testid="family"
        onKeyDown={(event) => moveByKey(event, shown, columns)}
      >
        <div className={css.rows} style={{ height: rows.getTotalSize() }} role="presentation">
          {rows.getVirtualItems().map(({ index, start }) => (
            <div key={index} className={css.row} style={{ transform: `translateY(${start}px)`, gap: GAP }} role="presentation">
              {shown.slice(index * columns, (index + 1) * columns).map((one, k) => (
                <Card key={one} asset={one} name={wrapName(ownName(one), letters)} words={words} width={card} place={index * columns + k} of={shown.length} large={large} />
              ))}
            </div>
          ))}
        </div>
      </div>
    </>
  );
}

/** The rows that are wholly in sight. */
function listInSight({ scrollOffset, scrollRect, getVirtualItems }: Virtualizer<HTMLDivElement, Element>): number[] {
  const [from, height] = [scrollOffset ?? 0, scrollRect?.height ?? 0];
  return getVirtualItems().flatMap(({ index, start, end }) => (start >= from && end - GAP <= from + height ? [index] : []));
}

/** Accepts the results that nobody reviewed and whose pictures are in sight; sorted by sureness, the next ones move up. */
function AcceptInSight({ assets }: { assets: readonly string[] }) {
  const cards = useProject((state) => state.cards);
  const open = assets.filter((asset) => cards[asset] && groupOf(cards[asset]) === "open");
  return (
    <div className={css.inSight}>
      <AcceptMany assets={open} what="in sight" tip="After a look at their pictures: accepts the unreviewed outputs that you see, if they are legal" />
    </div>
  );
}

/** Arrow keys go to the assets beside, above and below; Enter shows the one that is open in the view. */
export function moveByKey(event: KeyboardEvent, shown: readonly string[], columns: number): void {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  const { asset } = useWorkspace.getState();
  const here = asset === null ? -1 : shown.indexOf(asset);
  const page = columns * 4;
  const by = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns, PageUp: -page, PageDown: page };
  const end = { Home: 0, End: shown.length - 1 }[event.key];
  const step = (by as Record<string, number>)[event.key];
  const opens = event.key === "Enter" && useLayout.getState().gallery;
  if (opens) setLayout({ gallery: false });
  else if (end === undefined && step === undefined) return; // Enter beside the view is for what is in hand there
  event.preventDefault();
  const to = end ?? Math.min(Math.max(here + (step ?? 0), 0), shown.length - 1);
  if (opens || shown[to] === undefined) return;
  if (event.shiftKey && useWorkspace.getState().stage === "label") extendByKey(shown, to - here);
  else openAsset(shown[to]);
}

/** Shift and an arrow key: assets beside the open one come into view, from the end that was moved last. */
function extendByKey(shown: readonly string[], by: number): void {
  const { asset, sheet } = useWorkspace.getState();
  const here = shown.indexOf(asset ?? "");
  const places = sheet.map((one) => shown.indexOf(one)).filter((place) => place >= 0);
  const [low, high] = [Math.min(here, ...places), Math.max(here, ...places)];
  const end = high > here ? high : low < here ? low : here;
  const to = shown[Math.min(Math.max(end + by, 0), shown.length - 1)];
  if (to !== undefined) extendSheet(to);
}

/** The width inside an element, as it changes. */
function useWidth(box: RefObject<HTMLElement | null>): number {
  const [width, setWidth] = useState(264);
  useLayoutEffect(() => {
    const element = box.current;
    if (!element) return;
    const measure = () => setWidth(element.clientWidth);
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    measure();
    return () => observer.disconnect();
  }, [box]);
  return width;
}

/** Scrolls to the asset that is opened, wherever that was done, also when the pictures get another size. */
function useScrollToOpen(
  asset: string | null,
  size: string,
  shown: readonly string[],
  columns: number,
  scrollTo: (row: number) => void,
): void {
  const go = useEffectEvent(() => {
    const at = asset === null ? -1 : shown.indexOf(asset);
    if (at >= 0) scrollTo(Math.floor(at / columns));
  });
  useEffect(() => go(), [asset, size]);
}
