// Commands that take the open asset out of the family.
import { leaveOut, removeAsset, whyNotLeave } from "../store/members";
import { useWorkspace } from "../store/workspace";
import type { Command } from "./command";

const isAble = () => whyNotLeave(useWorkspace.getState().asset) === null;

function withOpen(does: (asset: string) => Promise<void>): () => unknown {
  return () => {
    const { asset } = useWorkspace.getState();
    return asset === null ? undefined : does(asset);
  };
}

export const memberCommands: readonly Command[] = [
  { id: "leave-out", title: "Leave this asset out of the family", group: "Edit", keys: [], enabled: isAble, run: withOpen(leaveOut) },
  { id: "remove-asset", title: "Remove this asset from the project", group: "Edit", keys: [], enabled: isAble, run: withOpen(removeAsset) },
];
