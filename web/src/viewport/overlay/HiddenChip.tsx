// How many hulls are in sight where some are hidden, and the way back.
import { Eye } from "lucide-react";
import { showAll } from "../../store/selection";
import { useScenes } from "../../store/scenes";
import { useWorkspace } from "../../store/workspace";
import { Button } from "../../ui/Button";
import css from "./tools.module.css";

export function HiddenChip() {
  const all = useScenes(({ scene }) => scene?.hulls.length ?? 0);
  const hidden = useWorkspace((workspace) => workspace.hidden.size);
  if (!hidden || !all) return null;
  return (
    <div className={css.chip} data-testid="hidden">
      <span role="status">
        {all - hidden} of {all} shown
      </span>
      <Button look="quiet" icon={Eye} onClick={showAll} tip="Show all hulls" keys="Alt+H">
        Show all
      </Button>
    </div>
  );
}
