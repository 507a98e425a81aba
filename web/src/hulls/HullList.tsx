// The list of hulls, in step with the view; pieces that are no hulls stand at its end with the reason.
import { useVirtualizer } from "@tanstack/react-virtual";
import { ArrowDown, ArrowUp, Search } from "lucide-react";
import { type KeyboardEvent, type MouseEvent, useEffect, useEffectEvent, useMemo, useRef, useState } from "react";
import { tonesOf } from "../pictures/hullColors";
import { hullNamesOf } from "../store/commonParts";
import { useProject } from "../store/project";
import { type Scene, useScenes } from "../store/scenes";
import { countText } from "../store/words";
import { hover, lookFrom, select, selectMore, useWorkspace, type WorkspaceState } from "../store/workspace";
import { HullRow, OpaqueRow } from "./HullRow";
import css from "./hulls.module.css";
import { COLUMNS, matchesSearch, namesBetween, nextOrder, type Order, rowsOf } from "./rows";

export function HullList() {
  const scene = useScenes((state) => state.scene);
  const [search, setSearch] = useState("");
  const [order, setOrder] = useState<Order>({ column: null, down: false });
  if (!scene) return null;
  const count = scene.hulls.length;
  return (
    <section className={css.list} aria-label="Hulls">
      <label className={css.search}>
        <Search size={14} aria-hidden />
        <input
          type="search"
          value={search}
          placeholder={`Search ${countText(count, "hull")}`}
          aria-label="Search hulls by name, label, body or shape"
          onChange={(event) => setSearch(event.target.value)}
        />
      </label>
      <Rows scene={scene} search={search} order={order} onOrder={setOrder} />
    </section>
  );
}

const HEIGHT = 26;
const HEAD = 26; // the head stays in sight, over the rows

interface RowsProps {
  scene: Scene;
  search: string;
  order: Order;
  onOrder: (order: Order) => void;
}

function Rows({ scene, search, order, onOrder }: RowsProps) {
  const vocabulary = useProject((state) => state.project.vocabulary);
  const colorBy = useWorkspace((workspace) => workspace.view.colorBy);
  const tone = useMemo(() => tonesOf(scene, colorBy, vocabulary), [scene, colorBy, vocabulary]);
  const rows = useMemo(() => rowsOf(scene.hulls, scene.contacts, search, order), [scene, search, order]);
  const names = useMemo(() => rows.map((row) => row.hull.name), [rows]);
  const shortOf = hullNamesOf(scene);
  const opaque = scene.view.non_convex.filter((piece) => matchesSearch(search, piece.name, piece.reason, piece.body));
  const grid = useRef<HTMLDivElement>(null);
  const virtual = useVirtualizer({
    count: rows.length + opaque.length,
    getScrollElement: () => grid.current,
    estimateSize: () => HEIGHT,
    scrollMargin: HEAD,
    scrollPaddingStart: HEAD,
    overscan: 8,
  });
  const reveal = (index: number) => virtual.scrollToIndex(index, { align: "auto" });
  const keys = useListKeys(names, reveal);
  const at = keys.active === null ? -1 : names.indexOf(keys.active);
  useFollowSelection(names, (index, name) => {
    reveal(index);
    keys.setActive(name);
  });
  return (
    <div
      ref={grid}
      role="grid"
      aria-label="Hulls"
      aria-multiselectable
      aria-rowcount={rows.length + opaque.length + 1}
      aria-activedescendant={at >= 0 ? `hull-${at}` : undefined}
      className={css.grid}
      tabIndex={0}
      data-first
      onKeyDown={(event) => event.target === event.currentTarget && keys.onKeyDown(event)}
    >
      <ListHead order={order} onOrder={onOrder} />
      <div
        role="rowgroup"
        onClick={keys.onClick}
        onDoubleClick={keys.onDoubleClick}
      >
        <div style={{ height: virtual.getTotalSize(), position: "relative" }} role="presentation">
          {virtual.getVirtualItems().map(({ index, start }) => {
            const row = rows[index];
            if (row) {
              const { name } = row.hull;
              const place = { index, top: start - HEAD, active: index === at };
              return <HullRow key={name} row={row} tone={tone(row.hull)} short={shortOf(name)} {...place} />;
            }
            const piece = opaque[index - rows.length];
            return piece && <OpaqueRow key={`opaque ${piece.name}`} piece={piece} index={index} top={start - HEAD} />;
          })}
        </div>
        {rows.length + opaque.length === 0 && <p className={css.none}>{search ? "No hull is found." : "No hulls."}</p>}
      </div>
    </div>
  );
}

/** Calls back with the place of a hull that was newly selected elsewhere. */
function useFollowSelection(names: readonly string[], follow: (index: number, name: string) => void): void {
  const look = useEffectEvent((now: WorkspaceState, before: WorkspaceState) => {
    if (now.selection === before.selection) return;
    const fresh = [...now.selection].find((name) => !before.selection.has(name));
    const index = fresh === undefined ? -1 : names.indexOf(fresh);
    if (fresh !== undefined && index >= 0) follow(index, fresh);
  });
  useEffect(() => useWorkspace.subscribe((now, before) => look(now, before)), []);
}

/** The heads of the list's columns; a click sorts. */
function ListHead({ order, onOrder }: { order: Order; onOrder: (order: Order) => void }) {
  return (
    <div role="row" aria-rowindex={1} className={css.head}>
      {COLUMNS.map(({ column, title, hint }) => {
        const sorted = order.column === column;
        return (
          <span key={column} role="columnheader" aria-sort={sorted ? (order.down ? "descending" : "ascending") : "none"}>
            <button type="button" title={`${hint}; click to sort`} onClick={() => onOrder(nextOrder(order, column))}>
              {title}
              {sorted && (order.down ? <ArrowDown size={11} aria-hidden /> : <ArrowUp size={11} aria-hidden />)}
            </button>
          </span>
        );
      })}
    </div>
  );
}

const PAGE = 10;

/** The row that the keys are at, and what keys and clicks do. reveal: brings a row into sight. */
function useListKeys(names: readonly string[], reveal: (index: number) => void) {
  const [active, setActive] = useState<string | null>(null);
  const [anchor, setAnchor] = useState<string | null>(null);
  const take = (name: string, event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean }) => {
    setActive(name);
    if (event.shiftKey) return select(namesBetween(names, anchor, name));
    setAnchor(name);
    selectMore([name], event.ctrlKey || event.metaKey ? "toggle" : "replace");
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.altKey) return;
    const next = rowAfterKey(names, active, event.key);
    if (next !== null) reveal(names.indexOf(next));
    if (next !== null && (event.ctrlKey || event.metaKey)) {
      setActive(next);
      hover(next);
    } else if (next !== null) take(next, { shiftKey: event.shiftKey, ctrlKey: false, metaKey: false });
    else if (event.key === " " && active !== null) selectMore([active], "toggle");
    else return;
    event.preventDefault();
  };
  const onClick = (event: MouseEvent) => {
    const row = event.target instanceof Element ? event.target.closest<HTMLElement>("[data-name]") : null;
    const name = row?.dataset["name"];
    if (name !== undefined) take(name, event);
  };
  const onDoubleClick = () => {
    if (useWorkspace.getState().selection.size) lookFrom("frame");
  };
  return { active, setActive, onKeyDown, onClick, onDoubleClick };
}

/** The row that a key goes to from another; null where it goes nowhere. */
function rowAfterKey(names: readonly string[], from: string | null, key: string): string | null {
  const by = { ArrowDown: 1, ArrowUp: -1, PageDown: PAGE, PageUp: -PAGE, Home: -Infinity, End: Infinity }[key];
  if (by === undefined || !names.length) return null;
  const at = from === null ? (by > 0 ? -1 : 0) : names.indexOf(from);
  return names[Math.min(names.length - 1, Math.max(0, at + by))] ?? null;
}
