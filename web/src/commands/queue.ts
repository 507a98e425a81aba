// Commands in turn: while one, or an edit, is still on its way, keys that are typed ahead wait for it.
import { pendingEdits } from "../store/edits";
import { reportError } from "../store/toasts";

/** What takes longer, as where the connection hangs, is no longer waited for [ms]. */
const PATIENCE = 10_000;

let last: Promise<unknown> | null = null;

/** Whether a command or an edit is on its way. */
export const isBusy = (): boolean => last !== null || pendingEdits() !== null;

/** Runs what a key means; one that means nothing yet may mean something once the edits on their way are done. */
export function runKey(meaning: () => (() => unknown) | undefined): void {
  const edits = meaning() === undefined ? pendingEdits() : null;
  const run = () => meaning()?.();
  runInTurn(edits === null ? run : () => edits.then(run));
}

/** Runs something once all before it is done; where it returns a promise, what comes after waits for it. */
export function runInTurn(run: () => unknown): void {
  track(last === null ? run() : last.then(run));
}

function track(result: unknown): void {
  if (!(result instanceof Promise)) return;
  const late = new Promise((pass) => setTimeout(pass, PATIENCE));
  const mine = Promise.race([result, late])
    .catch(reportError)
    .finally(() => {
      if (last === mine) last = null;
    });
  last = mine;
}
