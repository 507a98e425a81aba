// What a folder or an upload holds, and whether hulls are to be made of what has none.
import { Boxes } from "lucide-react";
import { setOptions, useDecompose } from "../store/decompose";
import { useStart } from "../store/start";
import { Check, Choice } from "../ui/fields";
import { HullSettings } from "../ui/HullSettings";
import { Note } from "../ui/Section";
import css from "./start.module.css";
import { brokenText, decomposeText, foundText, partsText, UNITS } from "./words";

export function Found() {
  const found = useStart((state) => state.found);
  const busy = useStart((state) => state.busy);
  const decompose = useStart((state) => state.decompose);
  const by = useDecompose(({ options }) => options.by ?? "whole");
  const bare = found && decomposeText(found);
  const parts = found && partsText(found, by);
  const broken = found && brokenText(found);
  return (
    <div role="status">
      {busy === "look" && <p className={css.dim}>Looking at the assets…</p>}
      {found && (
        <div className={css.found}>
          <p className={css.kinds}>
            <Boxes size={16} aria-hidden /> <b>{foundText(found)}</b>
          </p>
          {broken && <Note mood="warn">{broken}</Note>}
          {bare && (
            <Check checked={decompose} onChange={(is) => useStart.setState({ decompose: is })}>
              <b>Make convex hulls.</b> {bare}
            </Check>
          )}
          {bare && decompose && <HullSettings />}
          {parts && decompose && (
            <div className={css.method}>
              <Choice name="What is decomposed at a time" value={by} options={UNITS} onChange={(to) => setOptions({ by: to })} />
              <span className={css.dim}>{parts}</span>
            </div>
          )}
        </div>
      )}
    </div>
  );
}
