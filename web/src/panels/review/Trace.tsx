// What each rule did to this asset; the hulls light up while one points at a line.
import { select, setHighlight } from "../../store/desk";
import { highlightOfRule } from "../../store/lessons";
import { useProject } from "../../store/project";
import { counted, listed } from "../../store/words";
import type { EditedHeader, TraceLine } from "../../wire";
import { Section } from "../../ui/Section";
import { RuleText } from "../learn/RuleText";
import css from "./review.module.css";
import type { Of } from "./useResult";

export function Trace({ asset, of, edit }: { asset: string; of: Of; edit: EditedHeader }) {
  const stale = useProject((state) => of === "output" && (state.cards[asset]?.stale.includes("program") ?? false));
  if (!edit.trace.length) return null;
  return (
    <Section title="Rule by rule">
      {stale && <p className={css.dim}>As the program was when this was written.</p>}
      <ol className={css.trace}>
        {edit.trace.map((line) => (
          <Line key={line.rule} line={line} asset={asset} texts={!stale} />
        ))}
      </ol>
    </Section>
  );
}

function Line({ line, asset, texts }: { line: TraceLine; asset: string; texts: boolean }) {
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
        title={line.selected.length ? `Select what it made of ${listed(line.selected, 12)}` : undefined}
        onClick={() => select(line.made.length ? line.made : line.selected)}
        onPointerEnter={light}
        onPointerLeave={dark}
        onFocus={light}
        onBlur={dark}
      >
        <span className={css.number}>{line.rule}</span>
        <span className={css.traceText}>
          {text && <RuleText text={text} />}
          <span className={css.dim}>{did(line)}</span>
          {line.note && <span className={css.dim}>{line.note}</span>}
        </span>
      </button>
    </li>
  );
}

function did({ selected, made }: TraceLine): string {
  if (!selected.length) return "selected nothing here";
  const taken = counted(selected.length, "hull");
  return made.length ? `${taken} → ${made.length.toLocaleString("en-GB")}` : taken;
}
