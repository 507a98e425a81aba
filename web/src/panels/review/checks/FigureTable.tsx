// Figures before and after an edit.
import { figureText } from "../../../store/units";
import type { Figure } from "../../../wire";
import review from "../review.module.css";

export function FigureTable({ figures }: { figures: readonly Figure[] }) {
  return (
    <table className={review.numbers}>
      <thead>
        <tr>
          <td />
          <th scope="col">Before</th>
          <th scope="col">After</th>
        </tr>
      </thead>
      <tbody>
        {figures.map(({ what, unit, before, after }) => (
          <tr key={what}>
            <th scope="row">{what}</th>
            <td>{before === null ? "" : figureText(before, unit)}</td>
            <td>{figureText(after, unit)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
