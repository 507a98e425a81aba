// All that changes something goes to the server one after the other. An edit is on disk, and what it changed is on the
// page, when its promise is fulfilled with true.
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
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
  return enqueue(() => change(() => api.edit(edit), options.quiet ? null : capitalize));
}

export const undo = (): Promise<boolean> => enqueue(() => change(() => api.undo(), (said) => `Undone: ${said}`));
export const redo = (): Promise<boolean> => enqueue(() => change(() => api.redo(), (said) => `Redone: ${said}`));

/** Undoes or redoes one act after the other, until so many changes are done; said: what that is, in words. */
export function jumpTo(done: number, said: string): Promise<boolean> {
  const isBack = done < useProject.getState().history.undoable;
  return enqueue(() => change(() => (isBack ? api.undo : api.redo)(done), () => said));
}

/** Sends what rests on all edits before it, once the server accepted these; whether it was accepted itself. */
export function sendAfterEdits(request: () => Promise<unknown>): Promise<boolean> {
  const before = refused;
  return enqueue(async () => {
    const message = "This was not begun: a change before it was refused.";
    if (refused !== before) throw new ServerProblem({ message, where: null, remedy: "Look at what is there, then begin it again.", conflict: true }, 409);
    await request();
  });
}

/** What was done as a sentence: its first word, unless that is a name, with a capital letter. */
export const capitalize = (said: string): string => said.replace(/^[a-z](?=[a-z]*[ :])/, (first) => first.toUpperCase());

/** How many edits were refused. */
let refused = 0;

/** Does one request after those before; whether it was accepted. */
function enqueue(request: () => Promise<void>): Promise<boolean> {
  const mine = (queue ?? Promise.resolve()).then(async () => {
    try {
      await request();
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

/** Changes the project; tell: what the toast says of what was done, null for no toast. */
async function change(request: () => Promise<EditReceipt>, tell: ((said: string) => string) | null): Promise<void> {
  const before = useProject.getState();
  const done = await request().catch((error: unknown) => {
    refused += 1;
    throw error;
  });
  if (!done.nothing) await whenShown(before);
  if (tell && done.message) notify(tell(done.message), tell === capitalize && !done.nothing);
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
