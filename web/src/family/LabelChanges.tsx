// What the last edit of all labels changed: how many, where, and a way to each of them; until the next edit.
import { Undo2, X } from "lucide-react";
import css from "./labelChanges.module.css";
import { undo } from "../store/edits";
import {
  type ChangeKind,
  countChanges,
  dismissLabelChanges,
  openNextChange,
} from "../store/labelChanges";
import { useProject } from "../store/project";
import { labelProgress } from "../store/labelWalk";
import { countText } from "../store/words";
import { useWorkspace } from "../store/workspace";
import { Button, IconButton } from "../ui/Button";
import type { LabelUpdate } from "../wire";

const TITLES: Readonly<Record<LabelUpdate["way"], string>> = {
  "label-all": "Hulls labelled",
  "label-vlm": "Labels from a model",
};

/** Where labels are given, and nothing else is in hand. */
export function LabelChanges() {
  const relabelled = useProject((state) => state.relabelled);
  const isFree = useWorkspace(({ stage, tool }) => stage === "label" && tool !== "cut");
  return relabelled && isFree ? <ChangeBar relabelled={relabelled} /> : null;
}

function ChangeBar({ relabelled }: { relabelled: LabelUpdate }) {
  const { way } = relabelled;
  const unsure = useProject((state) => labelProgress(state.cards).unsure);
  return (
    <div className={css.outcome} role="status" aria-label={TITLES[way]}>
      <b>{TITLES[way]}</b>
      <ChangeButton relabelled={relabelled} sort="new" />
      <ChangeButton relabelled={relabelled} sort="changed" />
      <span className={css.count}>{unsure ? `${unsure.toLocaleString("en-GB")} unsure` : "none unsure"}</span>
      <span className={css.buttons}>
        <Button look="quiet" icon={Undo2} onClick={() => void undo()} tip="Undo all changes" keys="Ctrl+Z">
          Undo
        </Button>
        <IconButton icon={X} name="Dismiss; the labels stay" onClick={dismissLabelChanges} />
      </span>
    </div>
  );
}

function ChangeButton({ relabelled, sort }: { relabelled: LabelUpdate; sort: ChangeKind }) {
  const { hulls, assets } = countChanges(relabelled, sort);
  if (!hulls) return null;
  return (
    <button
      type="button"
      className={css.changed}
      title="Open the next asset with some"
      onClick={() => openNextChange(relabelled, sort)}
    >
      <span className={css.filled} aria-hidden />
      {hulls.toLocaleString("en-GB")} {sort} on {countText(assets, "asset")}
    </button>
  );
}
