// Undo, redo, and the list of all that was done and undone: where one is in it, and the way to any other state.
import { ChevronDown, Redo2, Undo2 } from "lucide-react";
import { Popover } from "radix-ui";
import { type KeyboardEvent, useId, useState } from "react";
import { api } from "../server/api";
import { capitalize, jumpTo, redo, undo } from "../store/edits";
import { useProject } from "../store/project";
import { countText } from "../store/words";
import { useWorkspace } from "../store/workspace";
import { IconButton } from "../ui/Button";
import { useAnswer } from "../ui/useAnswer";
import type { HistoryAct } from "../wire";
import css from "./TopBar.module.css";

export function History() {
  const history = useProject((state) => state.history);
  const open = useWorkspace((workspace) => workspace.overlay === "history");
  const none = history.undo === null && history.redo === null;
  return (
    <Popover.Root open={open} onOpenChange={(is) => useWorkspace.setState({ overlay: is ? "history" : "none" })}>
      <Popover.Anchor className={css.history}>
        <IconButton
          icon={Undo2}
          name={history.undo === null ? "Nothing to undo" : `Undo: ${history.undo}`}
          keys="Ctrl+Z"
          disabled={history.undo === null}
          onClick={() => void undo()}
        />
        <IconButton
          icon={Redo2}
          name={history.redo === null ? "Nothing to redo" : `Redo: ${history.redo}`}
          keys="Ctrl+Shift+Z"
          disabled={history.redo === null}
          onClick={() => void redo()}
        />
        <Popover.Trigger asChild>
          <IconButton icon={ChevronDown} name="History: all that was done and undone" keys="Alt+Z" disabled={none} />
        </Popover.Trigger>
      </Popover.Anchor>
      <Popover.Portal>
        <Popover.Content className={css.acts} align="start" sideOffset={5} aria-label="History" data-modeless>
          <Acts here={history.undoable} />
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}

interface State {
  /** How many changes are done in it. */
  readonly done: number;
  readonly title: string;
  readonly at: string;
}

/** The states that one can go to, the latest first. here: how many changes are done now. */
function Acts({ here }: { here: number }) {
  const id = useId();
  const history = useProject((state) => state.history);
  const found = useAnswer(history, () => api.history());
  const [chosen, setChosen] = useState(here);
  const states = statesOf(found?.acts ?? []);
  const placeOf = (done: number) => states.findIndex((state) => state.done === done);
  const [at, now] = [Math.max(0, placeOf(chosen)), placeOf(here)];
  const sayOf = (place: number) => `${place > now ? "Undo" : "Redo"} ${countText(Math.abs(place - now), "act")}`;
  const jump = (place: number) => {
    const to = states[place];
    if (to && place !== now) void jumpTo(to.done, `${sayOf(place).replace("do ", "done: ")}; now at: ${to.title}`);
  };
  const press = (event: KeyboardEvent) => {
    const to = { ArrowUp: at - 1, ArrowDown: at + 1, Home: 0, End: states.length - 1 }[event.key];
    if (to !== undefined) setChosen(states[Math.min(Math.max(to, 0), states.length - 1)]?.done ?? here);
    else if (event.key === "Enter") jump(at);
    else return;
    event.preventDefault();
  };
  return (
    <>
      <ul role="listbox" aria-label="States, the latest first" aria-activedescendant={states[at] && `${id}-${at}`} tabIndex={0} onKeyDown={press}>
        {states.map(({ done, title, at: when }, place) => (
          <li
            key={done}
            id={`${id}-${place}`}
            ref={(row) => (place === at ? row?.scrollIntoView({ block: "nearest" }) : undefined)}
            role="option"
            aria-selected={place === at}
            aria-current={place === now ? "step" : undefined}
            data-undone={place < now}
            onPointerMove={() => setChosen(done)}
            onClick={() => jump(place)}
          >
            <span>{title}</span>
            <time dateTime={when}>{timeText(when)}</time>
          </li>
        ))}
      </ul>
      <p role="status">{at === now ? "You are here. ↑ ↓ choose a state." : `${sayOf(at)}: Enter, or click`}</p>
    </>
  );
}

/** The state after each act, the latest first, and the one before all. */
function statesOf(acts: readonly HistoryAct[]): readonly State[] {
  const [first] = acts;
  if (!first) return [];
  const before = first.done - first.changes;
  const after = acts.map(({ title, at, done, changes }) => ({ title: capitalize(title) + (changes > 1 ? `, and ${changes - 1} more` : ""), at, done }));
  return [...after.reverse(), { done: before, title: before ? "Before these" : "Before all that was done", at: "" }];
}

/** The time of day, before today with the date. */
function timeText(when: string): string {
  if (!when) return "";
  const date = new Date(when);
  const time = date.toLocaleTimeString("en-GB", { timeStyle: "short" });
  return date.toDateString() === new Date().toDateString() ? time : `${date.toLocaleDateString("en-GB")} ${time}`;
}
