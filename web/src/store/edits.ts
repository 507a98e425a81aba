// All that changes something goes to the server one after the other. An edit is on disk, and what it changed is on the
// page, when its promise is fulfilled with true.
import { api } from "../server/api";
import { create } from "zustand";
import { ServerProblem } from "../server/http";
import type { AnyEdit, EditReceipt } from "../wire";
import { type ProjectState, useProject } from "./project";
import { reportError, notify } from "./toasts";

/** What takes longer to reach the page, as where the connection hangs, is no longer waited for [ms]. */
const PATIENCE = 3000;

let queue: Promise<unknown> | null = null;

/** How many edits are not saved yet. */
export const useUnsaved = create<{ count: number }>()(() => ({ count: 0 }));
const countUnsaved = (by: number) => useUnsaved.setState(({ count }) => ({ count: count + by }));

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
  countUnsaved(1);
  const mine = (queue ?? Promise.resolve()).then(async () => {
    try {
      await request();
      return true;
    } catch (error) {
      reportError(error);
      return false;
    } finally {
      countUnsaved(-1);
      if (queue === mine) queue = null;
    }
  });
  queue = mine;
  return mine;
}

/** Changes the project; tell: what the toast says of what was done, null for no toast. */
async function change(request: () => Promise<EditReceipt>, tell: ((said: string) => string) | null): Promise<void> {
  const before = useProject.getState();
  const done = await send(request).catch((error: unknown) => {
    refused += 1;
    throw error;
  });
  if (!done.nothing) await whenShown(before);
  if (tell && done.message) notify(tell(done.message), tell === capitalize && !done.nothing);
}

const isLost = ({ ready, connected }: ProjectState): boolean => ready && !connected;

/** Sends an edit; while there is no server it waits for one, so that nothing is lost. */
async function send(request: () => Promise<EditReceipt>): Promise<EditReceipt> {
  const { history, hellos, ready } = useProject.getState();
  try {
    if (!isLost(useProject.getState())) return await request();
  } catch (error) {
    if (!ready || !(error instanceof ServerProblem) || error.status !== 0) throw error;
    await Promise.race([until(isLost), new Promise((pass) => setTimeout(pass, PATIENCE))]);
    const now = useProject.getState();
    if (now.connected && now.hellos === hellos) throw error;
  }
  await until((now) => now.hellos !== hellos);
  // the server may have stopped after it had made the edit
  const { undoable, undo } = useProject.getState().history;
  return undoable === history.undoable ? request() : { message: undo ?? "", nothing: false };
}

function until(holds: (now: ProjectState) => boolean): Promise<void> {
  if (holds(useProject.getState())) return Promise.resolve();
  return new Promise((pass) => {
    const stop = useProject.subscribe((now) => {
      if (!holds(now)) return;
      stop();
      pass();
    });
  });
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
