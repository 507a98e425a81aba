// Which assets belong to the family: a menu that takes the open one out, and the list of those that are left out.
import { Ellipsis, Undo } from "lucide-react";
import { commonPartsOf, splitName } from "../store/commonParts";
import { leaveOut, putBack, removeAsset, whyNotLeave } from "../store/members";
import { useProject } from "../store/project";
import { countText } from "../store/words";
import { useWorkspace } from "../store/workspace";
import { Button, IconButton } from "../ui/Button";
import { Menu } from "../ui/Menu";
import css from "./members.module.css";

/** What can be done with the asset that is open. */
export function AssetMenu() {
  const asset = useWorkspace((workspace) => workspace.asset);
  const order = useProject((state) => state.order);
  const name = asset === null ? "the open asset" : ownName(asset, order);
  const disabled = order.length === 0 || whyNotLeave(asset) !== null;
  return (
    <Menu
      trigger={<IconButton icon={Ellipsis} name="Leave out or remove the open asset" />}
      lines={[
        { label: `Leave ${name} out of the family`, disabled, onSelect: () => asset !== null && void leaveOut(asset) },
        { label: `Remove ${name} from the project; its file stays`, disabled, onSelect: () => asset !== null && void removeAsset(asset) },
      ]}
    />
  );
}

/** What tells an asset from the others of its family. */
function ownName(asset: string, order: readonly string[]): string {
  const [, own, end] = splitName(asset, commonPartsOf(order)(asset));
  return own + end;
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
            <span title={asset}>{asset}</span>
            <Button look="quiet" icon={Undo} aria-label={`Put back ${asset}`} onClick={() => void putBack([asset])}>
              Put back
            </Button>
          </li>
        ))}
      </ul>
    </details>
  );
}
