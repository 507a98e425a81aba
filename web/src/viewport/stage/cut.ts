// Shows the cutting plane where the tool is in hand and a hull is chosen.
import { hullToCut, planeOf, useCutting } from "../../store/cutting";
import { useDesk } from "../../store/desk";
import { showsPreview } from "./appearance";
import type { Stage } from "./stage";

export function placeCut(stage: Stage): void {
  const { tool, selection } = useDesk.getState();
  const side = stage.shown;
  const hull = tool === "cut" && side ? hullToCut(side.scene, selection) : null;
  const plane = side && hull ? planeOf(side.scene, hull, useCutting.getState()) : null;
  const away = side?.hulls.aways[side.hulls.places.get(hull?.name ?? "") ?? -1] ?? [0, 0, 0];
  stage.change(({ made, cut }) => {
    if (made) made.object.visible = showsPreview(tool);
    cut.set(plane, hull?.shape ?? null, away.map((value) => value * stage.settings.explode));
  });
}
