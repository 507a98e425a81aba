// Numbers before and after an edit.
import { numbersOf } from "../../store/reviews";
import { changeText } from "../../store/words";
import type { EditedHeader, HullView } from "../../wire";
import { Section } from "../../ui/Section";
import css from "./review.module.css";

export function NumbersTable({ before, edit }: { before: readonly HullView[]; edit: EditedHeader }) {
  const numbers = numbersOf(before, edit);
  const whole = (value: number) => value.toLocaleString("en-GB");
  return (
    <Section title="Numbers" aside={`${edit.made.length} made, ${edit.removed.length} removed`}>
      <table className={css.numbers}>
        <thead>
          <tr>
            <td />
            <th scope="col">Before</th>
            <th scope="col">After</th>
            <th scope="col">Change</th>
          </tr>
        </thead>
        <tbody>
          <Row what="Hulls" pair={numbers.hulls} text={whole} />
          <Row what="Vertices" pair={numbers.vertices} text={whole} />
          <Row what="Faces" pair={numbers.faces} text={whole} />
          <Row what="Volume" pair={numbers.volume} text={volumeText} />
        </tbody>
      </table>
      {edit.note && <p className={css.dim}>{edit.note}</p>}
    </Section>
  );
}

function Row({ what, pair: [before, after], text }: { what: string; pair: readonly [number, number]; text: (value: number) => string }) {
  return (
    <tr>
      <th scope="row">{what}</th>
      <td>{text(before)}</td>
      <td>{text(after)}</td>
      <td>{changeText(before, after) ?? "–"}</td>
    </tr>
  );
}

/** A volume [m³] in a unit that leaves few digits. */
function volumeText(volume: number): string {
  const [value, unit] = volume >= 1 ? [volume, "m³"] : volume >= 1e-3 ? [volume * 1e3, "l"] : [volume * 1e6, "cm³"];
  return `${value.toPrecision(3).replace(/e\+.*$/, "")} ${unit}`;
}
