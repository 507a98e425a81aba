// The readings of a rule, side by side: all do what was shown, and differ elsewhere.
import { extractorOf, readingsOf } from "../../store/lessons";
import { useProject } from "../../store/project";
import type { RuleView } from "../../wire";
import css from "./learn.module.css";
import { ReadingRow } from "./ReadingRow";

const MOST = 12;

export function Readings({ rule }: { rule: RuleView }) {
  const lesson = useProject((state) => state.lesson);
  const readings = readingsOf(lesson, rule);
  const own = extractorOf(rule.text);
  if (!readings.length) return <p className={css.noReadings}>There is no other reading of it in the last lesson.</p>;
  return (
    <ul className={css.readings} aria-label={`Readings of rule ${rule.rule}`}>
      {readings.slice(0, MOST).map((reading) => (
        <ReadingRow key={reading.id} reading={reading} own={reading.extractor === own} />
      ))}
      {readings.length > MOST && <li className={css.dim}>and {readings.length - MOST} less believable ones</li>}
    </ul>
  );
}
