// Figures before and after an edit.
import type { ReactNode } from "react";
import css from "./review.module.css";

interface FigureRow {
  what: string;
  before: string;
  after: string;
  change?: ReactNode;
  /** Why the change stands out. */
  alarm?: string | null;
}

export function FigureTable({ rows, changes = false }: { rows: readonly FigureRow[]; changes?: boolean }) {
  return (
    <table className={css.numbers}>
      <thead>
        <tr>
          <td />
          <th scope="col">Before</th>
          <th scope="col">After</th>
          {changes && <th scope="col">Change</th>}
        </tr>
      </thead>
      <tbody>
        {rows.map(({ what, before, after, change, alarm = null }) => (
          <tr key={what}>
            <th scope="row">{what}</th>
            <td>{before}</td>
            <td>{after}</td>
            {changes && (
              <td data-alarm={alarm !== null || undefined} title={alarm ?? undefined}>
                {change}
              </td>
            )}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
