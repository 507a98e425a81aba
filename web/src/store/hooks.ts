// What several parts of the page ask of the stores.
import type { AssetView } from "../wire";
import { useDesk } from "./desk";
import { useScenes } from "./scenes";

/** Details of the asset in hand; null while they are on their way. */
export function useAssetView(): AssetView | null {
  const asset = useDesk((desk) => desk.asset);
  return useScenes(({ scene }) => (scene && scene.asset === asset ? scene.view : null));
}
