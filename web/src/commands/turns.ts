// Commands in turn: while one is still on its way, keys that are typed ahead wait for it.
import { complainedOf } from "../store/toasts";

/** What takes longer, as where the connection hangs, is no longer waited for [ms]. */
const PATIENCE = 10_000;

let last: Promise<unknown> | null = null;

/** Whether a command is on its way. */
export const isBusy = (): boolean => last !== null;

/** Runs something once all before it is done; where it returns a promise, what comes after waits for it. */
export function inTurn(run: () => unknown): void {
  follow(last === null ? run() : last.then(run));
}

function follow(result: unknown): void {
  if (!(result instanceof Promise)) return;
  const late = new Promise((pass) => setTimeout(pass, PATIENCE));
  const mine = Promise.race([result, late])
    .catch(complainedOf)
    .finally(() => {
      if (last === mine) last = null;
    });
  last = mine;
}
