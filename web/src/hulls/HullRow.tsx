// One hull or body in the list; it subscribes to its own hover and selection, so that the list never renders for them.
import { ChevronDown, ChevronRight } from "lucide-react";
import { memo } from "react";
import type { Tone } from "../pictures/hullColors";
import { volumeText } from "../store/units";
import { sureText } from "../store/assessment";
import { clearStepHighlight, highlightStep } from "../store/highlight";
import { countText, sourceText } from "../store/words";
import { hover, useUnit, useWorkspace } from "../store/workspace";
import { Name } from "../ui/Name";
import { Swatch } from "../ui/Section";
import { whilePointed } from "../ui/whilePointed";
import type { AssetView, NonConvexView } from "../wire";
import css from "./hulls.module.css";
import type { Line, Row } from "./rows";

interface Place {
  readonly index: number;
  readonly top: number;
}

const rowAt = ({ index, top }: Place) =>
  ({ id: `hull-${index}`, role: "row", "aria-rowindex": index + 2, style: { transform: `translateY(${top}px)` } }) as const;

interface InTree extends Place {
  /** What tells its name from the others. */
  readonly short: string;
  /** Whether the keys are at it. */
  readonly active: boolean;
}

interface BodyRowProps extends InTree {
  readonly line: Extract<Line, { body: string }>;
  readonly view: AssetView;
  readonly onTurn: () => void;
}

/** A body, which stands for all its hulls. */
export const BodyRow = memo(function BodyRow({ line: { key, body, names, open }, view, short, active, onTurn, ...place }: BodyRowProps) {
  const selected = useWorkspace(({ selection }) => names.filter((name) => selection.has(name)).length);
  return (
    <div
      {...rowAt(place)}
      aria-level={1}
      aria-expanded={open}
      aria-selected={selected === names.length}
      className={css.body}
      data-active={active}
      data-name={key}
      {...whilePointed(() => highlightStep(view, names), clearStepHighlight)}
    >
      <span role="gridcell" className={css.name} title={body}>
        <i
          aria-hidden
          onClick={(event) => {
            event.stopPropagation();
            onTurn();
          }}
        >
          {open ? <ChevronDown size={13} /> : <ChevronRight size={13} />}
        </i>
        <Name text={body} own={short} />
      </span>
      <span role="gridcell" className={css.number}>
        {selected ? `${selected} of ${countText(names.length, "hull")} selected` : countText(names.length, "hull")}
      </span>
    </div>
  );
});

interface HullRowProps extends InTree {
  readonly row: Row;
  readonly tone: Tone;
  /** 2 below a body; undefined in a list without bodies. */
  readonly level: number | undefined;
}

export const HullRow = memo(function HullRow({ row, tone, short, level, active, ...place }: HullRowProps) {
  const { hull, neighbours } = row;
  const unit = useUnit();
  const selected = useWorkspace((workspace) => workspace.selection.has(hull.name));
  const pointed = useWorkspace((workspace) => workspace.hover === hull.name);
  const hidden = useWorkspace((workspace) => workspace.hidden.has(hull.name));
  return (
    <div
      {...rowAt(place)}
      aria-level={level}
      aria-selected={selected}
      className={css.row}
      data-pointed={pointed}
      data-hidden={hidden}
      data-active={active}
      data-name={hull.name}
      onPointerEnter={() => hover(hull.name)}
      onPointerLeave={() => hover(null)}
    >
      <span role="gridcell" className={css.name} title={hidden ? `${hull.name} (hidden)` : hull.name}>
        <Swatch color={tone.color ?? "var(--hull-unlabelled)"} fill={tone.fill} />
        <Name text={hull.name} own={short} />
      </span>
      <span role="gridcell" title={labelTitle(row)}>
        {hull.label ?? <i aria-label="no label">–</i>}
      </span>
      <span role="gridcell" className={css.number}>
        {volumeText(hull.volume, unit)}
      </span>
      <span role="gridcell" className={css.number} title={`${hull.vertices} vertices, ${hull.faces} faces`}>
        {hull.primitive ?? `${hull.vertices} v`}
      </span>
      <span role="gridcell" className={css.number}>
        {neighbours}
      </span>
    </div>
  );
});

function labelTitle({ hull }: Row): string {
  if (hull.look === null) return "No label";
  const share = hull.confidence === null ? "" : sureText(hull.confidence);
  const parts = [hull.label ?? "no part", share, hull.source ? sourceText(hull.source) : ""];
  return parts.filter(Boolean).join(", ");
}

/** Collision geometry that is no hull, with the reason. */
export const OpaqueRow = memo(function OpaqueRow({ piece, ...place }: Place & { piece: NonConvexView }) {
  const pointed = useWorkspace((workspace) => workspace.hover === piece.name);
  return (
    <div
      {...rowAt(place)}
      aria-disabled
      className={css.opaque}
      data-pointed={pointed}
      onPointerEnter={() => hover(piece.name)}
      onPointerLeave={() => hover(null)}
    >
      <span role="gridcell" className={css.name} title={piece.name}>
        <Swatch color="var(--hull-pale)" fill="hatched" />
        <Name text={piece.name} />
      </span>
      <span role="gridcell" className={css.reason} title={piece.reason}>
        {piece.reason}
      </span>
    </div>
  );
});
