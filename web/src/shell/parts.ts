// The parts of the window, between which F6 moves the focus: top, family, view, steps, panel, hulls.

const FOCUSABLE = "button:not(:disabled), input:not([hidden]), [tabindex='0'], [role=tab][aria-selected=true]";

/** Puts the focus on the next part, or the one before, that can take it. */
export function toNextPart(by: 1 | -1): void {
  const parts = [...document.querySelectorAll<HTMLElement>("[data-part]")].filter((part) => firstIn(part) !== null);
  // parts may lie in parts: the innermost counts
  const here = parts.findLastIndex((part) => part.contains(document.activeElement));
  const next = here < 0 ? (by === 1 ? 0 : parts.length - 1) : (here + by + parts.length) % parts.length;
  const part = parts[next];
  if (part) firstIn(part)?.focus();
}

function firstIn(part: HTMLElement): HTMLElement | null {
  const chosen = part.querySelector<HTMLElement>("[data-first]");
  if (chosen) return chosen;
  return [...part.querySelectorAll<HTMLElement>(FOCUSABLE)].find((one) => one.offsetParent !== null) ?? null;
}
