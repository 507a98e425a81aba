// Keys mean commands, unless a person types, or a control that was reached by key wants them itself.
import { commandFor } from "../commands/all";
import { pressed } from "../commands/command";
import { useDesk } from "../store/desk";
import { toNextPart } from "./parts";

const IN_FIELDS = new Set(["Escape", "Ctrl+Enter", "Ctrl+K"]);
const OF_CONTROLS = new Set(["Enter", "Space"]);
const MOVES = /^(Shift\+)?Tab$|^Arrow/;
const MAY_REPEAT = /Tab$|^Ctrl\+(Shift\+)?[ZY]$/;
const FIELDS =
  "input:not([type=checkbox], [type=radio], [type=range], [type=button]), textarea, select, [contenteditable=true]";
const ROLES = ["tab", "option", "switch", "checkbox", "radio", "slider", "row", "gridcell", "listbox", "grid"];
const CONTROLS = ["button", "a", "summary", "input", ...ROLES.map((role) => `[role=${role}]`)].join(", ");
/** Where Tab goes to the next asset even though a key brought one there. */
const ASSET_TABS = "[data-tab-assets], [data-testid=viewport]";

/** Binds the keys of all commands to the window. */
export function bindKeys(): void {
  // whether keys, not the pointer, brought the focus to where it is; :focus-visible does not tell where a control
  // moved the focus by itself
  let byKey = false;
  window.addEventListener("pointerdown", () => (byKey = false), true);
  window.addEventListener("keydown", (event) => {
    if (event.defaultPrevented || event.isComposing) return;
    const key = pressed(event);
    const run = meaning(key, event.target, byKey && event.target !== document.body);
    if (run ? key.endsWith("F6") : MOVES.test(key)) byKey = true;
    if (!run) return;
    event.preventDefault();
    if (!event.repeat || MAY_REPEAT.test(key)) run();
  });
}

/** What a key pressed on an element does, if it is not left to the element and the browser. */
function meaning(key: string, target: EventTarget | null, byKey: boolean): (() => void) | undefined {
  if (!(target instanceof Element)) return undefined;
  const { overlay } = useDesk.getState();
  if (overlay === "help" || overlay === "palette") return undefined;
  if (target.closest("[role=dialog]:not([data-modeless]), [role=menu]")) return undefined;
  if (key === "F6" || key === "Shift+F6") return () => toNextPart(key === "F6" ? 1 : -1);
  if (target.closest(FIELDS) && !IN_FIELDS.has(key)) return undefined;
  if (/Tab$/.test(key) && byKey && !target.closest(ASSET_TABS)) return undefined;
  if (OF_CONTROLS.has(key) && byKey && target.closest(CONTROLS)) return undefined;
  return commandFor(key)?.run;
}
