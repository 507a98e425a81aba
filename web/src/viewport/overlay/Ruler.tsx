// The ruler over the view: what to click, what was measured, and marks at the points, each shape for a kind of point.
import { Trash2, X } from "lucide-react";
import { useEffect, useRef } from "react";
import { measureSelection } from "../../commands/measure";
import {
  clearMeasures,
  dropPoints,
  type Measure,
  measureBetween,
  measureText,
  removeMeasure,
  type RulerLine,
  type RulerPoint,
  useRuler,
} from "../../store/ruler";
import { ORIGIN, plus, type Triple } from "../../store/vectors";
import { useScenes } from "../../store/scenes";
import { setTool, setUnit, useUnit, useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Choice } from "../../ui/fields";
import { useFrame, useStage } from "../stage/context";
import type { Stage } from "../stage/stage";
import { separateSpots } from "./Marks";
import css from "./overlay.module.css";
import tools from "./tools.module.css";

const NONE: readonly Measure[] = [];

/** What was measured on the asset that is shown. */
function useMeasures(): readonly Measure[] {
  const asset = useScenes(({ scene }) => scene?.asset);
  const all = useRuler((state) => state.measures);
  return all.length ? all.filter((one) => one.asset === asset) : NONE;
}

const UNITS = [
  { value: "m", label: "m", name: "Metres" },
  { value: "mm", label: "mm", name: "Millimetres" },
] as const;

export function RulerBar() {
  const first = useRuler((state) => state.first);
  const pointed = useRuler((state) => state.pointed);
  const measures = useMeasures();
  const selected = useWorkspace((workspace) => workspace.selection.size);
  const asset = useScenes(({ scene }) => scene?.asset ?? "");
  const unit = useUnit();
  useEffect(() => dropPoints, []);
  return (
    <div className={css.bar} role="group" aria-label="Ruler" data-testid="ruler">
      <span className={tools.hint}>
        {first ? "Second point" : "First point"}
        {pointed && <b> · {pointed.snap}</b>}
      </span>
      {selected > 0 && (
        <Button onClick={measureSelection} keys="Shift+D" tip={selected === 2 ? "The gap between both hulls" : "How far the selected hulls reach along the axes"}>
          {selected === 2 ? "Gap of the selection" : "Extents of the selection"}
        </Button>
      )}
      <Choice name="Unit of lengths" value={unit} options={UNITS} onChange={setUnit} />
      {measures.length > 0 && <IconButton icon={Trash2} name="Clear all measures" onClick={() => clearMeasures(asset)} />}
      <IconButton icon={X} name="Put the ruler down" keys="Escape" onClick={() => setTool("select")} />
    </div>
  );
}

/** All measures of the asset, and the one that is under way. */
export function RulerMarks() {
  const measures = useMeasures();
  const { first, pointed } = useRuler();
  const unit = useUnit();
  const scene = useScenes((state) => state.scene);
  const inHand = useWorkspace((workspace) => workspace.tool === "ruler");
  const underWay = first && pointed && scene ? { ...measureBetween(scene, first, pointed), id: 0 } : null;
  const latest = measures.at(-1);
  const said = latest && measureText(latest, unit);
  return (
    <>
      <div className="visually-hidden" role="status">
        {latest && said && `${latest.what}: ${said.main}${said.along && `; ${said.along}`}`}
      </div>
      <Measures measures={underWay ? [...measures, underWay] : measures} />
      {inHand && first && <PointMark point={first} />}
      {inHand && pointed && <PointMark point={pointed} />}
    </>
  );
}

/** Where a point of a hull is seen [px]. */
function pixelOf(stage: Stage, hull: string, at: Triple): { x: number; y: number } | null {
  const pane = stage.panes().at(-1);
  if (!pane || !stage.shown) return null;
  const { hulls } = stage.shown;
  return stage.pixelOf(plus(at, hulls.aways[hulls.places.get(hull) ?? -1] ?? ORIGIN, stage.settings.explode), pane);
}

const LABEL = { wide: 276, high: 44 }; // px, with room between two

/** Lines with a label each, of which none covers another. */
function Measures({ measures }: { measures: readonly Measure[] }) {
  const stage = useStage();
  const holder = useRef<HTMLDivElement>(null);
  // what is new has its place after the next frame
  useEffect(() => stage.invalidate(), [stage, measures]);
  useFrame(() => {
    const parts = [...(holder.current?.children ?? [])];
    const ends = measures.map((measure) => measure.lines.map((line) => endsOf(stage, line)));
    const spots = separateSpots(ends.map((pairs) => labelSpot(stage, pairs)), LABEL.wide, LABEL.high);
    measures.forEach((_, m) => {
      const [lines, label] = [parts[2 * m], parts[2 * m + 1]];
      ends[m]?.forEach((pair, k) => drawLine(lines?.children[k], pair));
      const spot = spots[m];
      if (spot && label instanceof HTMLElement) {
        label.style.transform = `translate(${Math.round(spot.x)}px, ${Math.round(spot.y)}px) translate(-50%, -50%)`;
      }
    });
  });
  return (
    <div ref={holder} className={tools.measures}>
      {measures.map((measure) => (
        <MeasureMark key={measure.id} measure={measure} />
      ))}
    </div>
  );
}

/** Above the middle of its lines, and not over the rim of the view. */
function labelSpot(stage: Stage, pairs: readonly (Ends | null)[]): { x: number; y: number } {
  const all = pairs.flatMap((pair) => pair ?? []);
  const mean = (axis: "x" | "y") => all.reduce((sum, one) => sum + one[axis], 0) / (all.length || 1);
  const inside = (value: number, size: number, margin: number) => Math.min(Math.max(value, margin), Math.max(margin, size - margin));
  return { x: inside(mean("x"), stage.width, LABEL.wide / 2), y: inside(mean("y") - 28, stage.height, LABEL.high / 2) };
}

function MeasureMark({ measure }: { measure: Measure }) {
  const { main, along } = measureText(measure, useUnit());
  return (
    <>
      <svg className={tools.lines} aria-hidden>
        {measure.lines.map((_, k) => (
          <g key={k} data-axis={measure.length === null ? "xyz"[k] : undefined}>
            <line className={tools.rim} />
            <line />
            <circle r={3} />
            <circle r={3} />
          </g>
        ))}
      </svg>
      <div className={tools.measure} role="group" aria-label={measure.what} title={measure.what} data-testid="measure">
        <span>
          <b>{main}</b>
          {along && <small>{along}</small>}
        </span>
        {measure.id > 0 && <IconButton icon={X} name={`Remove: ${measure.what}`} onClick={() => removeMeasure(measure.id)} />}
      </div>
    </>
  );
}

type Ends = readonly { x: number; y: number }[];

function endsOf(stage: Stage, { ends, hulls }: RulerLine): Ends | null {
  const [a, b] = [pixelOf(stage, hulls[0], ends[0]), pixelOf(stage, hulls[1], ends[1])];
  return a && b ? [a, b] : null;
}

function drawLine(group: Element | undefined, ends: Ends | null): void {
  const [a, b] = ends ?? [];
  if (!group || !a || !b) return;
  const [rim, line, from, to] = group.children;
  for (const one of [rim, line]) setNumbers(one, { x1: a.x, y1: a.y, x2: b.x, y2: b.y });
  setNumbers(from, { cx: a.x, cy: a.y });
  setNumbers(to, { cx: b.x, cy: b.y });
}

function setNumbers(element: Element | undefined, numbers: Readonly<Record<string, number>>): void {
  for (const [name, value] of Object.entries(numbers)) element?.setAttribute(name, value.toFixed(1));
}

/** A square on a corner, a diamond on an edge, a ring on a face. */
function PointMark({ point }: { point: RulerPoint }) {
  const stage = useStage();
  const mark = useRef<HTMLDivElement>(null);
  useFrame(() => {
    const at = pixelOf(stage, point.hull, point.at);
    if (mark.current && at) mark.current.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
  });
  return (
    <div ref={mark} className={tools.point} aria-hidden>
      <i data-snap={point.snap} />
    </div>
  );
}
