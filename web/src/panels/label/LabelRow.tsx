// One label: its colour, its key, its name, how often it is used, and what can be done with it.
import { Ellipsis } from "lucide-react";
import { type KeyboardEvent, useState } from "react";
import { useDesk } from "../../store/desk";
import { perform } from "../../store/edits";
import { selectLabel } from "../../store/labelling";
import { applyLabel } from "../../store/queue";
import { IconButton } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import { Swatch } from "../../ui/Section";
import type { VocabularyLabel } from "../../wire";
import css from "./label.module.css";
import { Rename } from "./Rename";
import { InUse } from "./InUse";

interface LabelRowProps {
  label: VocabularyLabel;
  place: number;
  names: readonly string[];
  move: (to: number) => void;
  drag: object;
}

export function LabelRow({ label, place, names, move, drag }: LabelRowProps) {
  const { name, color, used } = label;
  const [state, setState] = useState<"shown" | "renamed" | "asked">("shown");
  const armed = useDesk((desk) => desk.brush === name);
  const remove = () => (used ? setState("asked") : removed(names, name));
  const onKeyDown = (event: KeyboardEvent) => {
    const act = keyed(event, place, move, () => setState("renamed"), remove);
    if (!act) return;
    event.preventDefault();
    act();
  };
  if (state === "renamed") return <Rename label={label} onDone={() => setState("shown")} />;
  return (
    <li className={css.row} data-armed={armed || undefined} {...drag}>
      <button
        type="button"
        className={css.label}
        aria-pressed={armed}
        aria-keyshortcuts={place < 9 ? String(place + 1) : undefined}
        onClick={(event) => (event.shiftKey ? selectLabel(name) : void applyLabel(name))}
        onDoubleClick={() => setState("renamed")}
        onKeyDown={onKeyDown}
      >
        <kbd data-empty={place > 8}>{place < 9 ? place + 1 : ""}</kbd>
        <Swatch color={color} />
        <span className={css.name}>{name}</span>
        <span className={css.count} aria-label={`${used} hulls have it`}>
          {used.toLocaleString("en-GB")}
        </span>
      </button>
      <Menu
        trigger={<IconButton icon={Ellipsis} name={`More for ${name}`} className={css.more} />}
        lines={[
          { label: "Rename", keys: "F2", onSelect: () => setState("renamed") },
          { label: "Select all hulls with it", keys: "Shift+click", onSelect: () => selectLabel(name) },
          { label: "Move up", keys: "Alt+↑", disabled: place === 0, onSelect: () => move(place - 1) },
          { label: "Move down", keys: "Alt+↓", disabled: place === names.length - 1, onSelect: () => move(place + 1) },
          "line",
          { label: "Remove", onSelect: remove },
        ]}
      />
      {state === "asked" && <InUse label={label} place={place} onClose={() => setState("shown")} />}
    </li>
  );
}

function removed(names: readonly string[], name: string): void {
  void perform({ kind: "vocabulary", labels: names.filter((other) => other !== name) });
}

/** What a key does to a row that has the focus. */
function keyed(
  event: KeyboardEvent,
  place: number,
  move: (to: number) => void,
  rename: () => void,
  remove: () => void,
) {
  if (event.key === "F2") return rename;
  if (event.key === "Delete" || event.key === "Backspace") return remove;
  if (event.altKey && event.key === "ArrowUp") return () => move(place - 1);
  if (event.altKey && event.key === "ArrowDown") return () => move(place + 1);
  return null;
}
