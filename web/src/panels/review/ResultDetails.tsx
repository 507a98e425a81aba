// What an edited asset comes to: numbers before and after, what the check of legality says, and what each rule did.
import { CircleAlert, CircleCheck, Info, TriangleAlert } from "lucide-react";
import { RuleText } from "../learn/RuleText";
import { problemOf, type ServerProblem } from "../../server/http";
import { highlightOfRule } from "../../store/highlight";
import { useProject } from "../../store/project";
import { alarmsOf, numbersOf, verdictOf } from "../../store/reviews";
import { type Scene, sceneOf } from "../../store/scenes";
import { textIn, volumeText } from "../../store/units";
import { changeText, countText, listText } from "../../store/words";
import { hover, select, setHighlight, useUnit, useWorkspace } from "../../store/workspace";
import { Section } from "../../ui/Section";
import type { EditHeader, FindingView, HullView, TraceLine } from "../../wire";
import { useAnswer } from "../../ui/useAnswer";
import { whilePointed } from "../../ui/whilePointed";
import { FigureTable } from "./FigureTable";
import css from "./review.module.css";

export function NumbersTable({ asset, before, edit }: { asset: string; before: readonly HullView[]; edit: EditHeader }) {
  const unit = useUnit();
  const numbers = numbersOf(before, edit);
  const alarms = alarmsOf(useProject((state) => state.confidence[asset]));
  const row = (what: string, [before, after]: readonly [number, number], text = wholeText, alarm: string | null = null) => ({
    what,
    before: text(before),
    after: text(after),
    change: (
      <>
        {alarm !== null && <TriangleAlert size={13} aria-label={`Alarm: ${alarm}:`} />}
        {changeText(before, after) ?? "–"}
      </>
    ),
    alarm,
  });
  const rows = [
    row("Hulls", numbers.hulls, wholeText, alarms.hulls),
    row("Vertices", numbers.vertices),
    row("Faces", numbers.faces),
    row("Volume", numbers.volume, (volume) => volumeText(volume, unit), alarms.volume),
  ];
  return (
    <Section title="Numbers" aside={[`${edit.made.length} made`, `${edit.removed.length} removed`, edit.changed.length && `${edit.changed.length} changed`].filter(Boolean).join(", ")}>
      <FigureTable rows={rows} changes />
      {edit.note && <p className={css.dim}>{edit.note}</p>}
    </Section>
  );
}

const wholeText = (value: number): string => value.toLocaleString("en-GB");

const ICONS = { error: CircleAlert, warning: TriangleAlert, note: Info } as const;
const NAMES = { error: "Error", warning: "Warning", note: "Note" } as const;

/** What the check of legality says of the edited asset. */
export function Findings({ edit }: { edit: EditHeader }) {
  const verdict = verdictOf(edit);
  return (
    <Section title="Legality" aside={edit.findings.length ? countText(edit.findings.length, "finding") : null}>
      {verdict === "legal" && (
        <p className={css.legal}>
          <CircleCheck size={15} aria-hidden /> All hulls are convex, closed and valid.
        </p>
      )}
      <ul className={css.findings}>
        {edit.findings.map((finding, k) => (
          <Finding key={k} finding={finding} />
        ))}
      </ul>
    </Section>
  );
}

function Finding({ finding: { severity, text, hull } }: { finding: FindingView }) {
  const unit = useUnit();
  const Icon = ICONS[severity];
  const words = (
    <>
      <Icon size={15} aria-label={NAMES[severity]} /> <span>{textIn(text, unit)}</span>
    </>
  );
  return (
    <li data-severity={severity}>
      {hull === null ? (
        <div className={css.finding}>{words}</div>
      ) : (
        <button
          type="button"
          className={css.finding}
          title={`Select ${hull}`}
          onClick={() => select([hull])}
          onPointerEnter={() => hover(hull)}
          onPointerLeave={() => hover(null)}
        >
          {words}
        </button>
      )}
    </li>
  );
}

/** What each rule did to this asset; the hulls are highlighted while one points at a line. */
export function Trace({ asset, of, edit }: { asset: string; of: ResultKind; edit: EditHeader }) {
  const stale = useProject((state) => of === "output" && (state.cards[asset]?.stale.includes("program") ?? false));
  if (!edit.trace.length) return null;
  return (
    <Section title="Rule by rule">
      {stale && <p className={css.dim}>From the program that wrote this output.</p>}
      <ol className={css.trace}>
        {edit.trace.map((line) => (
          <TraceRow key={line.rule} line={line} asset={asset} texts={!stale} />
        ))}
      </ol>
    </Section>
  );
}

function TraceRow({ line, asset, texts }: { line: TraceLine; asset: string; texts: boolean }) {
  const text = useProject((state) => (texts ? state.program.rules[line.rule - 1]?.text : undefined));
  const dark = () => setHighlight(null);
  const light = () => {
    const own = highlightOfRule(useProject.getState().reach, line.rule).assets[asset];
    if (own && texts) setHighlight({ what: `rule ${line.rule}`, assets: { [asset]: own } });
  };
  return (
    <li>
      <button
        type="button"
        className={css.traceLine}
        title={line.selected.length ? `Select the result for ${listText(line.selected, 12)}` : undefined}
        onClick={() => select(line.made.length ? line.made : line.selected)}
        {...whilePointed(light, dark)}
      >
        <span className={css.number}>{line.rule}</span>
        <span className={css.traceText}>
          {text && <RuleText text={text} />}
          <span className={css.dim}>{effectText(line)}</span>
          {line.note && <span className={css.dim}>{line.note}</span>}
        </span>
      </button>
    </li>
  );
}

function effectText({ selected, made }: TraceLine): string {
  if (!selected.length) return "selected nothing here";
  const taken = countText(selected.length, "hull");
  return made.length ? `${taken} → ${made.length.toLocaleString("en-GB")}` : taken;
}

type ResultKind = "program" | "output";

/** Which result of an asset is looked at: the one that is shown; else the written one, if there is one. */
export function useResultKind(asset: string): ResultKind {
  const showing = useWorkspace((state) => state.showing);
  const written = useProject((state) => ["edited", "unchanged"].includes(state.cards[asset]?.output ?? "none"));
  if (showing.kind === "result") return showing.of === "output" && !written ? "program" : showing.of;
  return written ? "output" : "program";
}

/** The result of an asset, or why there is none; null while it comes, and without a program. The one before stays till then. */
export function useResult(asset: string, of: ResultKind): Scene | ServerProblem | null {
  const state = useProject((now) =>
    [now.revisions[asset], now.shapeRevisions[asset], now.program.version, now.cards[asset]?.edited_picture].join(" "),
  );
  const empty = useProject((now) => of === "program" && !now.program.text.trim());
  const found = useAnswer(`${asset} ${of} ${state} ${empty}`, async () => (empty ? null : sceneOf(asset, { kind: "result", of }).catch(problemOf)));
  return empty ? null : found;
}
