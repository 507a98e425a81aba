// The head of the family: its number, adding assets, and how much room it has.
import { LayoutGrid, PanelLeftClose } from "lucide-react";
import { setLayout, useLayout } from "../store/layout";
import { useProject } from "../store/project";
import { IconButton } from "../ui/Button";
import { AddMenu } from "./AddMenu";
import css from "./family.module.css";
import { useShown } from "./useShown";

export function FamilyHead() {
  const all = useProject((state) => state.order.length);
  const gallery = useLayout((layout) => layout.gallery);
  const shown = useShown().length;
  return (
    <header className={css.head}>
      <h2>Family</h2>
      <span className={css.count} role="status" aria-label={`${shown} of ${all} assets shown`}>
        {shown === all ? all : `${shown} of ${all}`}
      </span>
      <AddMenu />
      <IconButton
        icon={LayoutGrid}
        name={gallery ? "Back to the view of one asset" : "Fill the centre with the family"}
        keys="Q"
        on={gallery}
        onClick={() => setLayout({ gallery: !gallery })}
      />
      {!gallery && (
        <IconButton icon={PanelLeftClose} name="Hide the family" keys="F9" onClick={() => setLayout({ family: false })} />
      )}
    </header>
  );
}
