// Assets that leave the family and come back; all that is kept for them stays.
import { perform } from "./edits";
import { useProject } from "./project";
import { openAsset, useWorkspace } from "./workspace";

/** Why assets cannot leave the family, null where they can. */
export function whyNotLeave(assets: readonly string[]): string | null {
  const { order } = useProject.getState();
  if (!assets.length || !assets.every((asset) => order.includes(asset))) return "No asset is open.";
  if (order.length > assets.length) return null;
  return assets.length > 1 ? "They are all assets of the family." : "It is the only asset of the family.";
}

/** Leaves assets out of the family; the next one that stays is opened where one of them was open. */
export async function leaveOut(assets: readonly string[]): Promise<void> {
  const { order } = useProject.getState();
  const last = Math.max(...assets.map((asset) => order.indexOf(asset)));
  const stays = (asset: string) => !assets.includes(asset);
  const next = order.slice(last).find(stays) ?? order.findLast(stays) ?? null;
  const done = await perform({ kind: "exclude", ids: [...assets], reason: "not of this family" });
  if (done && assets.includes(useWorkspace.getState().asset ?? "")) openAsset(next);
}

export const putBack = (assets: readonly string[]): Promise<boolean> =>
  perform({ kind: "exclude", ids: [...assets], reason: null });
