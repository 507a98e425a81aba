// The list of hulls, in step with the view; pieces that are no hulls stand at its end with the reason.
import { useVirtualizer } from "@tanstack/react-virtual";
import { Search } from "lucide-react";
import { useEffect, useMemo, useRef, useState } from "react";
import { useDesk } from "../store/desk";
import { useProject } from "../store/project";
import { useFormerLabels } from "../store/relabelled";
import { type Scene, useScenes } from "../store/scenes";
import { counted } from "../store/words";
import { tones } from "./colors/palette";
import { Head } from "./list/Head";
import { HullRow, OpaqueRow } from "./list/HullRow";
import css from "./list/list.module.css";
import { isFound, type Order, rowsOf } from "./list/rows";
import { useListKeys } from "./list/useListKeys";

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
          placeholder={`Search ${counted(count, "hull")}`}
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
  const colorBy = useDesk((desk) => desk.view.colorBy);
  const tone = useMemo(() => tones(scene, colorBy, vocabulary), [scene, colorBy, vocabulary]);
  const rows = useMemo(() => rowsOf(scene.hulls, scene.contacts, search, order), [scene, search, order]);
  const former = useFormerLabels(scene.asset, scene.view.hulls);
  const names = useMemo(() => rows.map((row) => row.hull.name), [rows]);
  const opaque = scene.view.opaque.filter((piece) => isFound(search, piece.name, piece.reason, piece.body));
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
      <Head order={order} onOrder={onOrder} />
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
              return <HullRow key={name} row={row} tone={tone(row.hull)} was={former.get(name)} {...place} />;
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
  const latest = useRef({ names, follow });
  useEffect(() => {
    latest.current = { names, follow };
  });
  useEffect(
    () =>
      useDesk.subscribe((now, before) => {
        if (now.selection === before.selection) return;
        const fresh = [...now.selection].find((name) => !before.selection.has(name));
        const index = fresh === undefined ? -1 : latest.current.names.indexOf(fresh);
        if (fresh !== undefined && index >= 0) latest.current.follow(index, fresh);
      }),
    [],
  );
}
