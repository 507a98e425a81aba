// The tree of bodies and hulls, in step with the view; pieces that are no hulls stand at its end with the reason.
import { useVirtualizer } from "@tanstack/react-virtual";
import { ArrowDown, ArrowUp, Search } from "lucide-react";
import { type KeyboardEvent, type MouseEvent, useEffect, useEffectEvent, useMemo, useRef, useState } from "react";
import { tonesOf } from "../pictures/hullColors";
import { hullNamesOf, ownPartsOf } from "../store/commonParts";
import { useProject } from "../store/project";
import { type Scene, useScenes } from "../store/scenes";
import { countText } from "../store/words";
import { hover, lookFrom, select, selectMore, useWorkspace, type WorkspaceState } from "../store/workspace";
import { BodyRow, HullRow, OpaqueRow } from "./HullRow";
import css from "./hulls.module.css";
import { COLUMNS, keysBetween, type Line, linesOf, matchesSearch, namesOf, nextOrder, type Order, rowsOf } from "./rows";

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
  const [closed, setClosed] = useState<ReadonlySet<string>>(new Set());
  const bodies = useMemo(() => (scene.parts ? [] : scene.hulls.map(({ body }) => body)), [scene]);
  const lines = useMemo(
    () => linesOf(rowsOf(scene.hulls, scene.contacts, search, order), bodies, closed),
    [scene, bodies, search, order, closed],
  );
  const isTree = lines.some((line) => "body" in line);
  const shortOf = hullNamesOf(scene);
  const opaque = scene.view.non_convex.filter((piece) => matchesSearch(search, piece.name, piece.reason, piece.body));
  const grid = useRef<HTMLDivElement>(null);
  const virtual = useVirtualizer({
    count: lines.length + opaque.length,
    getScrollElement: () => grid.current,
    estimateSize: () => HEIGHT,
    scrollMargin: HEAD,
    scrollPaddingStart: HEAD,
    overscan: 8,
  });
  const reveal = (index: number) => virtual.scrollToIndex(index, { align: "auto" });
  const turn = (body: string, open = closed.has(body)) =>
    setClosed(open ? new Set([...closed].filter((one) => one !== body)) : new Set([...closed, body]));
  const keys = useListKeys(lines, reveal, turn);
  const at = lines.findIndex(({ key }) => key === keys.active);
  useFollowSelection(lines, (index, key) => {
    if (keys.isActing()) return;
    reveal(index);
    keys.setActive(key);
  });
  return (
    <div
      ref={grid}
      role={isTree ? "treegrid" : "grid"}
      aria-label="Hulls"
      aria-multiselectable
      aria-rowcount={lines.length + opaque.length + 1}
      aria-activedescendant={at >= 0 ? `hull-${at}` : undefined}
      className={css.grid}
      tabIndex={0}
      data-first
      onKeyDown={(event) => event.target === event.currentTarget && keys.onKeyDown(event)}
    >
      <ListHead order={order} onOrder={onOrder} />
      <div role="rowgroup" onClick={keys.onClick} onDoubleClick={keys.onDoubleClick}>
        <div style={{ height: virtual.getTotalSize(), position: "relative" }} role="presentation">
          {virtual.getVirtualItems().map(({ index, start }) => {
            const line = lines[index];
            const place = { index, top: start - HEAD, active: index === at };
            if (line && "body" in line) {
              const { key, body } = line;
              return <BodyRow key={key} line={line} view={scene.view} short={ownPartsOf(bodies)(body)} onTurn={() => turn(body)} {...place} />;
            }
            if (line) {
              const { key, row } = line;
              const inBody = isTree && key.startsWith(`${row.hull.body}/`) ? key.slice(row.hull.body.length + 1) : shortOf(key);
              return <HullRow key={key} row={row} tone={tone(row.hull)} short={inBody} level={isTree ? 2 : undefined} {...place} />;
            }
            const piece = opaque[index - lines.length];
            return piece && <OpaqueRow key={`opaque ${piece.name}`} piece={piece} index={index} top={start - HEAD} />;
          })}
        </div>
        {lines.length + opaque.length === 0 && <p className={css.none}>{search ? "No hull is found." : "No hulls."}</p>}
      </div>
    </div>
  );
}

/** Calls back with the row of a hull that was newly selected elsewhere, or of its body where that is closed. */
function useFollowSelection(lines: readonly Line[], follow: (index: number, key: string) => void): void {
  const look = useEffectEvent((now: WorkspaceState, before: WorkspaceState) => {
    if (now.selection === before.selection) return;
    const fresh = [...now.selection].find((name) => !before.selection.has(name));
    const index = fresh === undefined ? -1 : lines.findLastIndex((line) => namesOf(line).includes(fresh));
    const line = lines[index];
    if (line) follow(index, line.key);
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

/** The row that the keys are at, and what keys and clicks do. reveal: brings a row into sight; turn: opens or closes a body. */
function useListKeys(lines: readonly Line[], reveal: (index: number) => void, turn: (body: string, open?: boolean) => void) {
  const [active, setActive] = useState<string | null>(null);
  const [anchor, setAnchor] = useState<string | null>(null);
  const keys = useMemo(() => lines.map(({ key }) => key), [lines]);
  const hullsOf = (some: readonly string[]) => lines.flatMap((line) => (some.includes(line.key) ? namesOf(line) : []));
  const acting = useRef(false);
  const take = (key: string, event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean }) => {
    setActive(key);
    acting.current = true;
    if (!event.shiftKey) setAnchor(key);
    if (event.shiftKey) select(hullsOf(keysBetween(keys, anchor, key)));
    else if (event.ctrlKey || event.metaKey) toggle(hullsOf([key]));
    else select(hullsOf([key]));
    acting.current = false;
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.altKey) return;
    const line = lines[keys.indexOf(active ?? "")];
    const next = keyAfter(lines, keys, active, event.key);
    if (next !== null) reveal(keys.indexOf(next));
    if (next !== null && (event.ctrlKey || event.metaKey)) {
      setActive(next);
      hover(hullsOf([next]).length === 1 ? next : null);
    } else if (next !== null) take(next, { shiftKey: event.shiftKey, ctrlKey: false, metaKey: false });
    else if (line && "body" in line && (event.key === "ArrowLeft" || event.key === "ArrowRight")) turn(line.body, event.key === "ArrowRight");
    else if (event.key === " " && active !== null) toggle(hullsOf([active]));
    else return;
    event.preventDefault();
  };
  const onClick = (event: MouseEvent) => {
    const row = event.target instanceof Element ? event.target.closest<HTMLElement>("[data-name]") : null;
    const key = row?.dataset["name"];
    if (key !== undefined) take(key, event);
  };
  const onDoubleClick = () => {
    if (useWorkspace.getState().selection.size) lookFrom("frame");
  };
  return { active, setActive, isActing: () => acting.current, onKeyDown, onClick, onDoubleClick };
}

/** Takes hulls off the selection where all are selected, else adds them. */
function toggle(names: readonly string[]): void {
  const { selection } = useWorkspace.getState();
  selectMore(names, names.every((name) => selection.has(name)) ? "subtract" : "add");
}

/** The row that a key goes to from another; null where it goes nowhere. */
function keyAfter(lines: readonly Line[], keys: readonly string[], from: string | null, key: string): string | null {
  const at = from === null ? -1 : keys.indexOf(from);
  const line = lines[at];
  if (key === "ArrowLeft" && line && "row" in line) return lines.slice(0, at).findLast((one) => "body" in one)?.key ?? null;
  const by = { ArrowDown: 1, ArrowUp: -1, PageDown: PAGE, PageUp: -PAGE, Home: -Infinity, End: Infinity }[key];
  if (by === undefined || !keys.length) return null;
  return keys[Math.min(keys.length - 1, Math.max(0, (at < 0 && by < 0 ? 0 : at) + by))] ?? null;
}
