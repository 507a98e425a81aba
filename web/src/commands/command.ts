// A thing that a person can do, by key, button, menu or the list of commands; one object each.
export interface Command {
  readonly id: string;
  /** In a few words, as the help shows it. */
  readonly title: string;
  readonly group: "Select" | "View" | "Label" | "Demonstrate" | "Learn" | "Review" | "Go" | "Edit";
  /** As `Ctrl+Shift+Z`, `A`, `Alt+A`, `Numpad1`; the first is shown. */
  readonly keys: readonly string[];
  /** Whether it makes sense now; always where it is left out. */
  readonly enabled?: () => boolean;
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
