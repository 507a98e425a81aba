// What is drawn besides the hulls, and how.
import { Ghost, Grid2x2X, Network, Triangle } from "lucide-react";
import { setView, useDesk, type ViewSettings } from "../../store/desk";
import { useScenes } from "../../store/scenes";
import { IconButton } from "../../ui/Button";
import { keyOf } from "./keys";
import css from "./toolbar.module.css";

export function Switches() {
  const ghosts = useScenes(({ scene }) => scene?.view.has_visual ?? false);
  const opaque = useScenes(({ scene }) => scene?.view.opaque.length ?? 0);
  return (
    <div className={css.group} role="group" aria-label="Shown besides">
      <Switch what="contacts" icon={Network} name="Contact graph, with near misses dashed" />
      <Switch what="wireframe" icon={Triangle} name="Wireframe" />
      {ghosts && <Switch what="ghost" icon={Ghost} name="Visual mesh as a ghost" />}
      {opaque > 0 && <Switch what="opaque" icon={Grid2x2X} name={`Pieces that are no hulls (${opaque})`} />}
    </div>
  );
}

type What = "contacts" | "wireframe" | "ghost" | "opaque";

function Switch({ what, icon, name }: { what: What; icon: typeof Ghost; name: string }) {
  const on = useDesk((desk) => desk.view[what]);
  const flip = (): Partial<ViewSettings> => ({ [what]: !on });
  return <IconButton icon={icon} name={name} keys={keyOf(`toggle-${what}`)} on={on} onClick={() => setView(flip())} />;
}
