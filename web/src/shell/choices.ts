// What the list of commands offers: commands that make sense now, and assets.
import { all } from "../commands/all";
import { openAsset } from "../store/desk";
import { useProject } from "../store/project";

export interface ChoiceLine {
  id: string;
  title: string;
  aside: string;
  keys: string | undefined;
  run: () => void;
}

export function choices(): readonly ChoiceLine[] {
  const commands = all
    .filter((command) => command.id !== "palette" && (command.enabled?.() ?? true))
    .map(({ id, title, group, keys, run }) => ({ id, title, aside: group, keys: keys[0], run }));
  const assets = useProject.getState().order.map((asset) => ({
    id: `asset ${asset}`,
    title: asset,
    aside: "Asset",
    keys: undefined,
    run: () => openAsset(asset),
  }));
  return [...commands, ...assets];
}
