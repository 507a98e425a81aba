// Edits go to the server one after the other; each is on disk, and what it changed is on the page, when its promise is
// fulfilled with true.
import { api } from "../server/api";
import type { AnyEdit, EditReceipt } from "../wire";
import { type ProjectState, useProject } from "./project";
import { reportError, notify } from "./toasts";

/** What takes longer to reach the page, as where the connection hangs, is no longer waited for [ms]. */
const PATIENCE = 3000;

let queue: Promise<unknown> | null = null;

/** Fulfilled when all edits that are on their way now are done; null where there is none. */
export const pendingEdits = (): Promise<unknown> | null => queue;

/** Makes an edit; notifies what was done, or what went wrong. */
export function perform(edit: AnyEdit, options: { quiet?: boolean } = {}): Promise<boolean> {
  return enqueue(() => api.edit(edit), options.quiet ? null : capitalize);
}

export const undo = (): Promise<boolean> => enqueue(() => api.undo(), (said) => `Undone: ${said}`);
export const redo = (): Promise<boolean> => enqueue(() => api.redo(), (said) => `Redone: ${said}`);

/** Undoes or redoes one act after the other, until so many changes are done; said: what that is, in words. */
export function jumpTo(done: number, said: string): Promise<boolean> {
  const isBack = done < useProject.getState().history.undoable;
  return enqueue(() => (isBack ? api.undo : api.redo)(done), () => said);
}

/** What was done as a sentence: its first word, unless that is a name, with a capital letter. */
export const capitalize = (said: string): string => said.replace(/^[a-z](?=[a-z]*[ :])/, (first) => first.toUpperCase());

/** Does one request after those before; tell: what the toast says of what was done, null for no toast. */
function enqueue(request: () => Promise<EditReceipt>, tell: ((said: string) => string) | null): Promise<boolean> {
  const mine = (queue ?? Promise.resolve()).then(async () => {
    const before = useProject.getState();
    try {
      const done = await request();
      if (!done.nothing) await whenShown(before);
      if (tell && done.message) notify(tell(done.message), tell === capitalize && !done.nothing);
      return true;
    } catch (error) {
      reportError(error);
      return false;
    } finally {
      if (queue === mine) queue = null;
    }
  });
  queue = mine;
  return mine;
}

/** Waits until the page knows what its edit changed; before: the state when the edit was sent. */
function whenShown(before: ProjectState): Promise<void> {
  const isOver = (now: ProjectState) => !now.connected || now.own !== before.own || now.hellos !== before.hellos;
  return new Promise((pass) => {
    const end = () => {
      stop();
      clearTimeout(late);
      pass();
    };
    const stop = useProject.subscribe((now) => isOver(now) && end());
    const late = setTimeout(end, PATIENCE);
    if (isOver(useProject.getState())) end();
  });
}
