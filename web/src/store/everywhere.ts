// A change of one rule on several assets.
import { changeSteps } from "./steps";
import { complainedOf } from "./toasts";

/** Gives the step in a place (from 0) another action, on each of some assets. */
export async function changeEverywhere(assets: readonly string[], place: number, action: string): Promise<void> {
  try {
    for (const asset of assets) {
      const done = await changeSteps(asset, (steps) =>
        steps.map((step, k) => (k === place ? { ...step, action } : step)),
      );
      if (!done) return;
    }
  } catch (error) {
    complainedOf(error);
  }
}
