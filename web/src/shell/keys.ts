// Keys mean commands, unless a person types, or a control that was reached by key wants them itself.
import { pressedKeys } from "../commands/command";
import { commandFor, listCommands } from "../commands/list";
import { isBusy, runKey } from "../commands/queue";
import { useStart } from "../store/start";
import { useWorkspace } from "../store/workspace";

const IN_FIELDS = new Set(["Escape", "Ctrl+Enter", "Ctrl+K"]);
const OF_CONTROLS = new Set(["Enter", "Space"]);
const MOVES = /^(Shift\+)?Tab$|^Arrow/;
const MAY_REPEAT = /Tab$|^Ctrl\+(Shift\+)?[ZY]$/;
const FIELDS =
  "input:not([type=checkbox], [type=radio], [type=range], [type=button]), textarea, select, [contenteditable=true]";
const ROLES = ["tab", "option", "switch", "checkbox", "radio", "slider", "row", "gridcell", "listbox", "grid", "treegrid"];
const CONTROLS = ["button", "a", "summary", "input", ...ROLES.map((role) => `[role=${role}]`)].join(", ");
/** The list of hulls selects by Space alone, so that Enter is for the action in hand. */
const NO_ENTER = "[role=grid], [role=treegrid]";
/** Where Tab goes to the next asset even though a key brought one there; F6 leads on. */
const ASSET_TABS = "[data-testid=viewport]";

/** Binds the keys of all commands to the window. */
export function bindKeys(): void {
  // whether keys, not the pointer, brought the focus to where it is; :focus-visible does not tell where a control
  // moved the focus by itself
  let byKey = false;
  window.addEventListener("pointerdown", () => (byKey = false), true);
  window.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing || useStart.getState().view !== null) return;
    const key = pressedKeys(event);
    const { target } = event;
    const open = isOpen(key, target, byKey && target !== document.body);
    const isOurs = open && (actionOf(key) !== undefined || (isBusy() && isCommand(key)));
    if (isOurs ? isToPart(key) || commandFor(key)?.movesFocus : MOVES.test(key)) byKey = true;
    if (!isOurs) return;
    event.preventDefault();
    if (!event.repeat || MAY_REPEAT.test(key)) runKey(() => actionOf(key));
  });
}

/** Whether a key pressed on an element is not left to the element and the browser. */
function isOpen(key: string, target: EventTarget | null, byKey: boolean): boolean {
  if (!(target instanceof Element)) return false;
  const { overlay } = useWorkspace.getState();
  if (overlay === "help" || overlay === "palette") return false;
  if (target.closest("[role=dialog]:not([data-modeless]), [role=menu]")) return false;
  if (isToPart(key)) return true;
  if (target.closest(FIELDS) && !IN_FIELDS.has(key)) return false;
  if (/Tab$/.test(key) && byKey && !target.closest(ASSET_TABS)) return false;
  const control = OF_CONTROLS.has(key) && byKey ? target.closest(CONTROLS) : null;
  return control === null || (key === "Enter" && control.matches(NO_ENTER));
}

const isToPart = (key: string): boolean => key === "F6" || key === "Shift+F6";

/** What a key does now. */
function actionOf(key: string): (() => unknown) | undefined {
  return isToPart(key) ? () => toNextPart(key === "F6" ? 1 : -1) : commandFor(key)?.run;
}

/** Whether a key may mean something once the commands that are on their way are done. */
const isCommand = (key: string): boolean => listCommands().some((command) => command.keys.includes(key));

const FOCUSABLE = "button:not(:disabled), input:not([hidden]), [tabindex='0']:not([role=separator]), [role=tab][aria-selected=true]";

/** Puts the focus on the next part, or the one before, that can take it. */
function toNextPart(by: 1 | -1): void {
  const parts = [...document.querySelectorAll<HTMLElement>("[data-part]")].filter((part) => firstIn(part) !== null);
  // parts may lie in parts: the innermost counts
  const here = parts.findLastIndex((part) => part.contains(document.activeElement));
  const next = here < 0 ? (by === 1 ? 0 : parts.length - 1) : (here + by + parts.length) % parts.length;
  const part = parts[next];
  if (part) firstIn(part)?.focus();
}

/** The first element of a part that can take the focus, but for those of parts within it. */
function firstIn(part: HTMLElement): HTMLElement | null {
  const isOwn = (one: HTMLElement) => one.closest("[data-part]") === part;
  const chosen = [...part.querySelectorAll<HTMLElement>("[data-first]")].find(isOwn);
  if (chosen) return chosen;
  return [...part.querySelectorAll<HTMLElement>(FOCUSABLE)].find((one) => isOwn(one) && one.offsetParent !== null) ?? null;
}
