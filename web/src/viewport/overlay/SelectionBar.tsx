// What labelling has in hand, over the view: the label that is painted, assets side by side, and hulls that are selected
// on several assets, with a way to take each off.
import { Columns3, X } from "lucide-react";
import { useEffect } from "react";
import { selectedByAsset, unselectAsset } from "../../store/familySelection";
import { useOwnNames, useProject } from "../../store/project";
import { useScenes } from "../../store/scenes";
import { toggleSheet } from "../../store/sheet";
import { prepareSimilar, useSimilar } from "../../store/similar";
import { countText } from "../../store/words";
import { openAsset, select, setBrush, setView, useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Name } from "../../ui/Name";
import { Swatch } from "../../ui/Section";
import css from "./selectionBar.module.css";

export function SelectionBar() {
  const stage = useWorkspace((workspace) => workspace.stage);
  const brush = useWorkspace((workspace) => workspace.brush);
  const isSheet = useWorkspace((workspace) => workspace.sheet.length > 0);
  const isWide = useWorkspace((workspace) => workspace.elsewhere.size > 0);
  const some = useWorkspace((workspace) => workspace.selection.size > 0);
  const searching = useSimilar((state) => state.searching);
  useEffect(() => {
    if ((some || brush) && stage === "label") prepareSimilar();
  }, [some, brush, stage]);
  if (stage !== "label") return null;
  return (
    <>
      {brush !== null && <Paint brush={brush} />}
      {isSheet || isWide ? <Several /> : searching && (
        <div className={css.bar} role="status">
          Looking for look-alikes…
        </div>
      )}
    </>
  );
}

/** The label in hand. */
function Paint({ brush }: { brush: string }) {
  const color = useBrushColor(brush);
  const place = useProject(({ project }) => 1 + project.vocabulary.findIndex(({ name }) => name === brush));
  return (
    <div className={css.bar} role="status" data-testid="painting">
      <Swatch color={color} />
      <b>
        Painting: {brush || "no label"}
        {place < 10 && ` (${place})`}
      </b>
      <span className={css.faint}>click hulls with what is outlined, or drag</span>
      <Button look="quiet" onClick={() => setBrush(null)} tip="Select again">
        <kbd>Esc</kbd> ends
      </Button>
    </div>
  );
}

/** A frame around the view in the colour of the label that is painted. */
export function BrushFrame() {
  const brush = useWorkspace((workspace) => (workspace.stage === "label" ? workspace.brush : null));
  const color = useBrushColor(brush ?? "");
  return brush === null ? null : <div className={css.frame} style={{ borderColor: color }} aria-hidden />;
}

const useBrushColor = (brush: string): string =>
  useProject(({ project }) => project.vocabulary.find(({ name }) => name === brush)?.color) ?? "var(--text-dim)";

function Several() {
  const sheet = useWorkspace((workspace) => workspace.sheet.length);
  const isWide = useWorkspace((workspace) => workspace.elsewhere.size > 0);
  // what is selected decides what is said
  useWorkspace((workspace) => workspace.selection);
  useWorkspace((workspace) => workspace.elsewhere);
  const groups = [...selectedByAsset()].sort(([a], [b]) => a.localeCompare(b, "en", { numeric: true }));
  const hulls = groups.reduce((sum, [, names]) => sum + names.length, 0);
  const last = useSimilar((state) => state.last);
  const searching = useSimilar((state) => state.searching);
  const isUneven = useScenes(({ scene }) => scene?.isUneven);
  const oneSize = useWorkspace((workspace) => workspace.view.oneSize);
  return (
    <div className={css.bar} role="status" aria-label="Several assets" data-testid="several">
      {sheet > 0 && <b>{countText(sheet, "asset")} side by side</b>}
      {hulls > 0 && (
        <details className={css.groups}>
          <summary>
            {countText(hulls, "hull")} selected on {countText(groups.length, "asset")}
          </summary>
          <ul>
            {groups.map(([asset, names]) => (
              <Group key={asset} asset={asset} count={names.length} />
            ))}
          </ul>
        </details>
      )}
      {searching && <span className={css.faint}>looking…</span>}
      {last?.more && hulls > 0 && <span className={css.faint}>{last.where === "here" ? "J" : "Shift+J"} again takes more</span>}
      <Button look="quiet" icon={Columns3} onClick={toggleSheet} keys="W" tip={sheet ? "Show the open asset alone" : "Show them in one view"}>
        {sheet ? "One asset" : "Side by side"}
      </Button>
      {sheet > 0 && isUneven && (
        <Button look="quiet" onClick={() => setView({ oneSize: !oneSize })} tip={oneSize ? "Draw them as large as they are to each other" : "Draw all as large as the first; each name says by how much"}>
          {oneSize ? "True sizes" : "One size"}
        </Button>
      )}
      {isWide && <IconButton icon={X} name="Select nothing" keys="Esc" onClick={() => select([])} />}
    </div>
  );
}

function Group({ asset, count }: { asset: string; count: number }) {
  const ownName = useOwnNames();
  return (
    <li>
      <button type="button" className={css.asset} title={`Open ${asset}`} onClick={() => openAsset(asset)}>
        <Name text={asset} own={ownName(asset)} />
      </button>
      <span className={css.faint}>{count}</span>
      <IconButton icon={X} name={`Take ${countText(count, "hull")} of ${asset} off the selection`} onClick={() => unselectAsset(asset)} />
    </li>
  );
}
