// Edits go to the server one after the other; each is on disk when its promise is fulfilled with true.
import { api } from "../server/api";
import type { AnyEdit, Done } from "../wire";
import { complainedOf, told } from "./toasts";

let queue: Promise<unknown> = Promise.resolve();

/** Makes an edit; tells what was done, or what went wrong. */
export function perform(edit: AnyEdit, options: { quiet?: boolean } = {}): Promise<boolean> {
  return inTurn(() => api.edit(edit), options.quiet ? null : true);
}

export const undo = (): Promise<boolean> => inTurn(api.undo, false);
export const redo = (): Promise<boolean> => inTurn(api.redo, false);

/** Does one request after those before; offer: whether the toast offers undo, null for no toast. */
function inTurn(request: () => Promise<Done>, offer: boolean | null): Promise<boolean> {
  const mine = queue.then(async () => {
    try {
      const done = await request();
      if (offer !== null && done.said) told(done.said, offer && !done.nothing);
      return true;
    } catch (error) {
      complainedOf(error);
      return false;
    }
  });
  queue = mine;
  return mine;
}
