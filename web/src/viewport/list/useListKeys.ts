// Keys and clicks on the list: they move along the rows, and select one, more, or a range.
import { type KeyboardEvent, type MouseEvent, useState } from "react";
import { hover, lookFrom, select, selectMore, useDesk } from "../../store/desk";
import { between } from "./rows";

export interface ListKeys {
  /** The row that the keys are at. */
  readonly active: string | null;
  readonly setActive: (name: string) => void;
  readonly onKeyDown: (event: KeyboardEvent) => void;
  readonly onClick: (event: MouseEvent) => void;
  readonly onDoubleClick: () => void;
}

const PAGE = 10;

/** reveal: brings a row into sight. */
export function useListKeys(names: readonly string[], reveal: (index: number) => void): ListKeys {
  const [active, setActive] = useState<string | null>(null);
  const [anchor, setAnchor] = useState<string | null>(null);
  const take = (name: string, event: { shiftKey: boolean; ctrlKey: boolean; metaKey: boolean }) => {
    setActive(name);
    if (event.shiftKey) return select(between(names, anchor, name));
    setAnchor(name);
    selectMore([name], event.ctrlKey || event.metaKey ? "toggle" : "replace");
  };
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.altKey) return;
    const next = moved(names, active, event.key);
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
    if (useDesk.getState().selection.size) lookFrom("frame");
  };
  return { active, setActive, onKeyDown, onClick, onDoubleClick };
}

/** The row that a key goes to from another; null where it goes nowhere. */
function moved(names: readonly string[], from: string | null, key: string): string | null {
  const by = { ArrowDown: 1, ArrowUp: -1, PageDown: PAGE, PageUp: -PAGE, Home: -Infinity, End: Infinity }[key];
  if (by === undefined || !names.length) return null;
  const at = from === null ? (by > 0 ? -1 : 0) : names.indexOf(from);
  return names[Math.min(names.length - 1, Math.max(0, at + by))] ?? null;
}
