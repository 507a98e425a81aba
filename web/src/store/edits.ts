// Edits go to the server one after the other; each is on disk when its promise is fulfilled with true.
import { api } from "../server/api";
import type { AnyEdit, Done } from "../wire";
import { complainedOf, told } from "./toasts";

let queue: Promise<unknown> = Promise.resolve();

/** Makes an edit; tells what was done, or what went wrong. */
export function perform(edit: AnyEdit, options: { quiet?: boolean } = {}): Promise<boolean> {
  return inTurn(() => api.edit(edit), options.quiet ? null : sentence);
}

export const undo = (): Promise<boolean> => inTurn(api.undo, (said) => `Undone: ${said}`);
export const redo = (): Promise<boolean> => inTurn(api.redo, (said) => `Redone: ${said}`);

/** What was done as a sentence: its first word, unless that is a name, with a capital letter. */
export const sentence = (said: string): string => said.replace(/^[a-z](?=[a-z]*[ :])/, (first) => first.toUpperCase());

/** Does one request after those before; tell: what the toast says of what was done, null for no toast. */
function inTurn(request: () => Promise<Done>, tell: ((said: string) => string) | null): Promise<boolean> {
  const mine = queue.then(async () => {
    try {
      const done = await request();
      if (tell && done.said) told(tell(done.said), tell === sentence && !done.nothing);
      return true;
    } catch (error) {
      complainedOf(error);
      return false;
    }
  });
  queue = mine;
  return mine;
}
