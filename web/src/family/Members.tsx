// Which assets belong to the family: a menu that takes the open one out, and the list of those that are left out.
import { Ellipsis, Undo } from "lucide-react";
import { useShallow } from "zustand/react/shallow";
import { leaveOut, putBack, whyNotLeave } from "../store/members";
import { useOwnNames, useProject } from "../store/project";
import { assetsInView } from "../store/sheet";
import { countText } from "../store/words";
import { useWorkspace } from "../store/workspace";
import { Button, IconButton } from "../ui/Button";
import { Menu } from "../ui/Menu";
import { Name } from "../ui/Name";
import css from "./members.module.css";

/** What can be done with the asset that is open, or with those side by side. */
export function AssetMenu() {
  const assets = useWorkspace(useShallow(assetsInView));
  const none = useProject((state) => state.order.length === 0);
  const ownName = useOwnNames();
  const [first] = assets;
  const name = first === undefined ? "the open asset" : assets.length > 1 ? `these ${assets.length} assets` : ownName(first);
  const disabled = none || whyNotLeave(assets) !== null;
  return (
    <Menu
      trigger={<IconButton icon={Ellipsis} name={`Leave out ${assets.length > 1 ? "the assets side by side" : "the open asset"}`} />}
      lines={[{ label: `Leave ${name} out of the family`, disabled, onSelect: () => void leaveOut(assets) }]}
    />
  );
}

/** Assets that are kept, but not part of the family. */
export function LeftOut() {
  const ids = useProject((state) => state.project.left_out);
  if (ids.length === 0) return null;
  return (
    <details className={css.leftOut}>
      <summary>{countText(ids.length, "asset")} left out</summary>
      <ul>
        {ids.map((asset) => (
          <li key={asset} className={css.row}>
            <span title={asset}>
              <Name text={asset} />
            </span>
            <Button look="quiet" icon={Undo} aria-label={`Put back ${asset}`} onClick={() => void putBack([asset])}>
              Put back
            </Button>
          </li>
        ))}
      </ul>
    </details>
  );
}
