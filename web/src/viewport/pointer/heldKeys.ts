// Keys that count for one drag alone: where one is held while something is dragged, what it switched on goes off again
// as it is let go.
import { pressedKeys } from "../../commands/command";
import { THROUGH_KEY } from "../../commands/select";
import { setBrush, setThrough, useWorkspace } from "../../store/workspace";

/** A key that is down: its code, and how to take back what it did. */
interface Held {
  readonly code: string;
  readonly takeBack: () => void;
}

let held: Held | null = null;
let dragged = false;

/** Something was dragged to its end; a key that is held then was for this alone. */
export function noteDrag(): void {
  dragged = held !== null;
}

/** Watches the keys of painting and of selecting through, until the returned function is called. */
export function watchHeldKeys(): () => void {
  const stop = new AbortController();
  const on = <K extends keyof WindowEventMap>(kind: K, does: (event: WindowEventMap[K]) => void) =>
    window.addEventListener(kind, does, { signal: stop.signal });
  on("keydown", (event) => {
    if (event.repeat) return;
    held = takeBackOf(event);
    dragged = false;
  });
  on("keyup", ({ code }) => {
    if (held?.code !== code) return;
    if (dragged) held.takeBack();
    held = null;
  });
  on("blur", () => (held = null));
  return () => stop.abort();
}

/** What lets go of a key, where it is one of these. */
function takeBackOf(event: KeyboardEvent): Held | null {
  const key = pressedKeys(event);
  const { code } = event;
  if (/^\d$/.test(key)) return { code, takeBack: () => setBrush(null) };
  if (key !== THROUGH_KEY) return null;
  return { code, takeBack: () => setThrough(!useWorkspace.getState().through) };
}
