// Assets that leave the family and come back: left out and kept, or removed from the project.
import { perform } from "./edits";
import { neighbour } from "./family";
import { useProject } from "./project";
import { openAsset, useWorkspace } from "./workspace";

/** Why an asset cannot leave the family, null where it can. */
export function whyNotLeave(asset: string | null): string | null {
  const { order } = useProject.getState();
  if (asset === null || !order.includes(asset)) return "No asset is open.";
  return order.length > 1 ? null : "It is the only asset of the family.";
}

/** Leaves an asset out of the family; all that is kept for it stays. */
export const leaveOut = (asset: string): Promise<void> =>
  goOn(asset, () => perform({ kind: "leave-out", ids: [asset], out: true }));

/** Removes an asset from the project, with what is kept for it; its own file stays. */
export const removeAsset = (asset: string): Promise<void> =>
  goOn(asset, () => perform({ kind: "remove-assets", ids: [asset] }));

export const putBack = (assets: readonly string[]): Promise<boolean> =>
  perform({ kind: "leave-out", ids: [...assets], out: false });

/** Does what takes an asset away, then opens the next one where that one was open. */
async function goOn(asset: string, does: () => Promise<boolean>): Promise<void> {
  const { order } = useProject.getState();
  const next = neighbour(order, order, asset, 1);
  if ((await does()) && useWorkspace.getState().asset === asset) openAsset(next);
}
