// A list of all that can be done, with why not where that is not now, and of all assets, by name.
import { Dialog } from "radix-ui";
import { type KeyboardEvent, useEffect, useId, useMemo, useRef, useState } from "react";
import { type PaletteLine, paletteLines, rankLines } from "../commands/list";
import { close, Overlay } from "./Overlay";
import css from "./overlay.module.css";

const MOST = 200;

export const Palette = () => (
  <Overlay which="palette">
    <Dialog.Title className="visually-hidden">Find a command or an asset</Dialog.Title>
    <List />
  </Overlay>
);

function List() {
  const id = useId();
  const all = useMemo(paletteLines, []);
  const [search, setSearch] = useState("");
  const [at, setAt] = useState(0);
  const shown = rankLines(all, search).slice(0, MOST);
  const run = (place: number) => {
    const choice = shown[place];
    if (!choice || choice.reason !== null) return;
    close();
    // once the dialog has given the focus back
    setTimeout(choice.run);
  };
  function key(event: KeyboardEvent): void {
    const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (by !== undefined && shown.length) setAt((at + by + shown.length) % shown.length);
    else if (event.key === "Enter") run(at);
    else return;
    event.preventDefault();
  }
  return (
    <>
      <input
        className={css.wide}
        role="combobox"
        aria-expanded
        aria-controls={id}
        aria-activedescendant={shown[at] ? `${id}-${at}` : undefined}
        aria-label="Find a command or an asset"
        placeholder="Find a command or an asset"
        value={search}
        onChange={(event) => {
          setSearch(event.target.value);
          setAt(0);
        }}
        onKeyDown={key}
      />
      <ul id={id} role="listbox" aria-label="Matches" className={css.list}>
        {shown.map((choice, place) => (
          <Row
            key={choice.id}
            id={`${id}-${place}`}
            choice={choice}
            on={place === at}
            onRun={() => run(place)}
            onPoint={() => setAt(place)}
          />
        ))}
        {shown.length === 0 && <li className={css.none}>No match.</li>}
      </ul>
    </>
  );
}

interface RowProps {
  id: string;
  choice: PaletteLine;
  on: boolean;
  onRun: () => void;
  onPoint: () => void;
}

function Row({ id, choice: { title, aside, keys, reason }, on, onRun, onPoint }: RowProps) {
  const row = useRef<HTMLLIElement>(null);
  useEffect(() => {
    if (on) row.current?.scrollIntoView({ block: "nearest" });
  }, [on]);
  return (
    <li
      ref={row}
      id={id}
      role="option"
      aria-selected={on}
      aria-disabled={reason !== null}
      className={css.option}
      onClick={onRun}
      onPointerMove={onPoint}
    >
      <span className={css.grow}>{title}</span>
      <span className={css.aside} title={reason ?? undefined}>
        {reason ?? aside}
      </span>
      {keys && <kbd>{keys}</kbd>}
    </li>
  );
}
