// Commands that take the open asset, or all that are side by side, out of the family.
import { leaveOut, removeAssets, whyNotLeave } from "../store/members";
import { assetsInView } from "../store/sheet";
import { useWorkspace } from "../store/workspace";
import type { Command } from "./command";

const isAble = () => whyNotLeave(assetsInView(useWorkspace.getState())) === null;

const withChosen = (does: (assets: readonly string[]) => Promise<void>) => () => does(assetsInView(useWorkspace.getState()));

export const memberCommands: readonly Command[] = [
  { id: "leave-out", title: "Leave this asset, or all side by side, out of the family", group: "Edit", keys: [], enabled: isAble, run: withChosen(leaveOut) },
  { id: "remove-asset", title: "Remove this asset, or all side by side, from the project", group: "Edit", keys: [], enabled: isAble, run: withChosen(removeAssets) },
];
