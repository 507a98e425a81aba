// One label: its colour, its key, its name, how often it is used, and what can be done with it.
import { Ellipsis } from "lucide-react";
import { type KeyboardEvent, useEffect, useState } from "react";
import { perform } from "../../store/edits";
import { selectLabel } from "../../store/labels";
import { useProject } from "../../store/project";
import { applyLabel } from "../../store/labelWalk";
import { countText } from "../../store/words";
import { setFilters, setHighlight, useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import { Note, Swatch } from "../../ui/Section";
import type { VocabularyLabel } from "../../wire";
import css from "./label.module.css";

interface LabelRowProps {
  label: VocabularyLabel;
  /** How many hulls have it; null while that is not known yet. */
  used: number | null;
  place: number;
  names: readonly string[];
  move: (to: number) => void;
  drag: object;
}

export function LabelRow({ label, used, place, names, move, drag }: LabelRowProps) {
  const { name, color } = label;
  const [state, setState] = useState<"shown" | "renamed" | "asked">("shown");
  const armed = useWorkspace((workspace) => workspace.brush === name);
  const remove = () => (used !== 0 ? setState("asked") : removeLabel(names, name));
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key === "F2") setState("renamed");
    else if (event.key === "Delete" || event.key === "Backspace") remove();
    else if (event.altKey && event.key === "ArrowUp") move(place - 1);
    else if (event.altKey && event.key === "ArrowDown") move(place + 1);
    else return;
    event.preventDefault();
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
        <span className={css.count}>
          {used === null ? "…" : used.toLocaleString("en-GB")}
          <span className="visually-hidden">{used === null ? " being counted" : ` ${used === 1 ? "hull has" : "hulls have"} it`}</span>
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
      {state === "asked" && <InUse name={name} used={used} place={place} onClose={() => setState("shown")} />}
    </li>
  );
}

function removeLabel(names: readonly string[], name: string): void {
  void perform({ kind: "vocabulary", labels: names.filter((other) => other !== name) });
}

/** A label while its name is changed, in its place in the list. */
function Rename({ label: { name, color }, onDone }: { label: VocabularyLabel; onDone: () => void }) {
  const [text, setText] = useState(name);
  const finish = () => {
    const now = text.trim();
    if (now && now !== name) void perform({ kind: "rename-label", old: name, new: now });
    onDone();
  };
  return (
    <li className={css.row}>
      <span className={css.label}>
        <kbd data-empty />
        <Swatch color={color} />
        <input
          autoFocus
          className={css.rename}
          aria-label={`New name of ${name}`}
          value={text}
          onFocus={(event) => event.target.select()}
          onChange={(event) => setText(event.target.value)}
          onBlur={finish}
          onKeyDown={(event) => {
            if (event.key === "Enter") finish();
            if (event.key === "Escape") onDone();
            if (event.key === "Enter" || event.key === "Escape") event.preventDefault();
          }}
        />
      </span>
    </li>
  );
}

const inUseText = (used: number): string =>
  used === 0
    ? "No hull has it any more: remove it now."
    : `${countText(used, "hull")} ${used === 1 ? "has" : "have"} it; give ${used === 1 ? "it" : "them"} another label first.`;

/** Why a label cannot be removed, and a way to the hulls that have it. */
function InUse({ name, used, place, onClose }: Pick<LabelRowProps, "used" | "place"> & { name: string; onClose: () => void }) {
  useEffect(() => () => conceal(name), [name]);
  return (
    <div className={css.inUse} role="status">
      <Note mood="warn">
        {used === null ? "The assets are still being read: wait until it is known whether hulls have it." : inUseText(used)}
        <div className={css.buttons}>
          <Button look="quiet" onClick={() => reveal(name, place)}>
            Show them
          </Button>
          <Button look="quiet" onClick={onClose}>
            Close
          </Button>
        </div>
      </Note>
    </div>
  );
}

/** Selects the hulls with a label, and points them out in the family. */
function reveal(name: string, place: number): void {
  const { cards } = useProject.getState();
  const having = Object.values(cards).map(
    ({ asset, labels }) => [asset, labels.flatMap((label, k) => (label === place ? [k] : []))] as const,
  );
  selectLabel(name);
  setFilters({ search: name });
  setHighlight({ what: name, assets: Object.fromEntries(having.filter(([, hulls]) => hulls.length)) });
}

/** The family is as it was before the label was pointed out. */
function conceal(name: string): void {
  const { filters, highlight } = useWorkspace.getState();
  if (filters.search === name) setFilters({ search: "" });
  if (highlight?.what === name) setHighlight(null);
}
