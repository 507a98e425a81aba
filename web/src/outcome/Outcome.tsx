// What the last edit of all labels changed: how many, where, and a way to each of them; until the next edit.
import { Undo2, X } from "lucide-react";
import { useEffect } from "react";
import { useDesk } from "../store/desk";
import { undo } from "../store/edits";
import { useProject } from "../store/project";
import {
  lightRelabelled,
  nextRelabelled,
  putAside,
  type Sort,
  tally,
  unlightRelabelled,
  useRelabelled,
} from "../store/relabelled";
import { labelProgress } from "../store/unsure";
import { counted } from "../store/words";
import { Button, IconButton } from "../ui/Button";
import type { Relabelled } from "../wire";
import css from "./outcome.module.css";

const DONE: Readonly<Record<Relabelled["way"], string>> = {
  propagate: "Labels carried over",
  "label-files": "Labels taken from files",
  "label-names": "Labels taken from names",
  "label-vlm": "Labels from a model",
};

/** Where labels are given, and nothing else is in hand. */
export function Outcome() {
  const relabelled = useRelabelled();
  const isFree = useDesk(({ stage, tool }) => stage === "label" && tool !== "cut");
  return relabelled && isFree ? <Told relabelled={relabelled} /> : null;
}

function Told({ relabelled }: { relabelled: Relabelled }) {
  const { settled, way } = relabelled;
  const unsure = useProject((state) => labelProgress(state.cards).unsure);
  useEffect(() => unlightRelabelled, []);
  return (
    <div className={css.outcome} role="status" aria-label={DONE[way]}>
      <b>{DONE[way]}</b>
      <Changed relabelled={relabelled} sort="new" />
      <Changed relabelled={relabelled} sort="changed" />
      {settled > 0 && <span className={css.count}>{settled.toLocaleString("en-GB")} now sure</span>}
      <span className={css.count}>{unsure ? `${unsure.toLocaleString("en-GB")} unsure` : "all sure"}</span>
      <span className={css.buttons}>
        <Button look="quiet" icon={Undo2} onClick={() => void undo()} tip="Take all of it back" keys="Ctrl+Z">
          Undo
        </Button>
        <IconButton icon={X} name="Put this aside; the labels stay" onClick={putAside} />
      </span>
    </div>
  );
}

function Changed({ relabelled, sort }: { relabelled: Relabelled; sort: Sort }) {
  const { hulls, assets } = tally(relabelled, sort);
  if (!hulls) return null;
  return (
    <button
      type="button"
      className={css.changed}
      title="Points them out in the family; a click goes to the next asset that has some"
      onPointerEnter={() => lightRelabelled(relabelled, sort)}
      onPointerLeave={unlightRelabelled}
      onFocus={() => lightRelabelled(relabelled, sort)}
      onBlur={unlightRelabelled}
      onClick={() => nextRelabelled(relabelled, sort)}
    >
      <span className={css.filled} aria-hidden />
      {hulls.toLocaleString("en-GB")} {sort} on {counted(assets, "asset")}
    </button>
  );
}
