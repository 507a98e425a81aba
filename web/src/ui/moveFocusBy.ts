// Keys that go from one element of a list to the next.
import type { KeyboardEvent } from "react";

/** Moves the focus among the elements of a list by a key pressed in it; steps: how far each key goes. */
export function moveFocusBy(event: KeyboardEvent, steps: Readonly<Record<string, number>>, selector: string): void {
  const by = steps[event.key];
  if (by === undefined || event.altKey) return;
  event.preventDefault();
  const all = [...event.currentTarget.querySelectorAll<HTMLElement>(selector)];
  const here = all.findIndex((one) => one === document.activeElement);
  all[Math.min(Math.max(here + by, 0), all.length - 1)]?.focus();
}
