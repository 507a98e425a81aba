// The camera: projection, fitting, standard views; and the grid.
import { Box, Check, Cuboid, Maximize, Video } from "lucide-react";
import { lookFrom, setView, useDesk } from "../../store/desk";
import { useScenes } from "../../store/scenes";
import { IconButton } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import { commandOf, keyOf, linesOf } from "./keys";
import css from "./toolbar.module.css";

export function ViewMenu() {
  const parallel = useDesk((desk) => desk.view.projection === "orthographic");
  const grid = useDesk((desk) => desk.view.grid);
  // whether something is shown decides which lines make sense
  useScenes(({ scene }) => scene === null);
  return (
    <div className={css.group} role="group" aria-label="Camera">
      <IconButton
        icon={parallel ? Box : Cuboid}
        name={parallel ? "Parallel projection; switch to perspective" : "Perspective; switch to parallel projection"}
        keys={keyOf("projection")}
        onClick={commandOf("projection").run}
      />
      <IconButton icon={Maximize} name="Fit all into the view" keys={keyOf("fit")} onClick={() => lookFrom("fit")} />
      <Menu
        trigger={
          <button type="button" className={css.camera} aria-label="Standard views" title="Standard views">
            <Video size={16} aria-hidden />
          </button>
        }
        lines={[
          ...linesOf(["view-front", "view-back", "view-right", "view-left", "view-top", "view-bottom", "view-iso"]),
          "line",
          ...linesOf(["fit", "frame"]),
          "line",
          {
            label: (
              <span className={css.labelLine}>
                <Check size={13} aria-hidden style={{ visibility: grid ? "visible" : "hidden" }} /> Grid and axes
              </span>
            ),
            onSelect: () => setView({ grid: !grid }),
          },
        ]}
      />
    </div>
  );
}
