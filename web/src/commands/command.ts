// A thing that a person can do, by key, button, menu or the list of commands; one object each.
import { type StageName, STAGES, useWorkspace } from "../store/workspace";

/** Whether something can be done now, and, where not, why. */
export type Condition = (() => boolean) & { readonly reason: () => string | null };

/** A condition, and what is said where it does not hold. */
export const needs = (text: string | (() => string), is: () => boolean): Condition =>
  Object.assign(() => is(), { reason: () => (is() ? null : typeof text === "string" ? text : text()) });

/** What can be done unless there is a reason why not. */
export const unless = (reason: () => string | null): Condition => Object.assign(() => reason() === null, { reason });

export const NAMES = { label: "Label", demonstrate: "Demonstrate", learn: "Learn", review: "Review" } as const;

/** What can be done in one stage, and where something else holds, too. */
export const inStage = (stage: StageName, more?: Condition): Condition =>
  unless(() => (useWorkspace.getState().stage === stage ? (more?.reason() ?? null) : `Open ${NAMES[stage]} first (Alt+${STAGES.indexOf(stage) + 1}).`));

export interface Command {
  readonly id: string;
  /** In a few words, as the help shows it. */
  readonly title: string;
  readonly group: "Select" | "View" | "Label" | "Demonstrate" | "Learn" | "Review" | "Go" | "Edit";
  /** As `Ctrl+Shift+Z`, `A`, `Alt+A`, `Numpad1`; the first is shown. */
  readonly keys: readonly string[];
  /** Whether it makes sense now; always where it is left out. */
  readonly enabled?: Condition;
  /** Other words that people look for. */
  readonly words?: string;
  /** Does it; where it takes a while, keys that are typed ahead wait for the promise. */
  readonly run: () => unknown;
  /** Whether it moves the focus, so that Tab goes on from there. */
  readonly movesFocus?: boolean;
}

/** Commands of one group, unless one says another; without keys where none are given. */
export function commandsOf(group: Command["group"], all: readonly (Omit<Command, "group" | "keys"> & Partial<Command>)[]): readonly Command[] {
  return all.map((one) => ({ group, keys: [], ...one }));
}

/** The name of a pressed key combination, as commands list it. */
export function pressedKeys(event: {
  key: string;
  code: string;
  ctrlKey: boolean;
  metaKey: boolean;
  altKey: boolean;
  shiftKey: boolean;
}): string {
  const key = keyName(event);
  const isSign = key.length === 1 && !/[A-Z0-9]/.test(key);
  const shift = event.shiftKey && !isSign;
  return [event.ctrlKey || event.metaKey ? "Ctrl" : "", event.altKey ? "Alt" : "", shift ? "Shift" : "", key]
    .filter(Boolean)
    .join("+");
}

function keyName({ key, code }: { key: string; code: string }): string {
  if (code.startsWith("Numpad")) return code;
  // with Alt or another layout the key may be a special letter; its place tells what is meant
  if (/^Key[A-Z]$/.test(code) && !/^[a-zA-Z]$/.test(key)) return code.slice(3);
  if (key === " ") return "Space";
  return key.length === 1 ? key.toUpperCase() : key;
}
