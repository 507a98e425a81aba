// The heads of the list's columns; a click sorts.
import { ArrowDown, ArrowUp } from "lucide-react";
import css from "./list.module.css";
import { clicked, COLUMNS, type Order } from "./rows";

export function Head({ order, onOrder }: { order: Order; onOrder: (order: Order) => void }) {
  return (
    <div role="row" aria-rowindex={1} className={css.head}>
      {COLUMNS.map(({ column, title, hint }) => {
        const sorted = order.column === column;
        return (
          <span key={column} role="columnheader" aria-sort={sorted ? (order.down ? "descending" : "ascending") : "none"}>
            <button type="button" title={`${hint}; click to sort`} onClick={() => onOrder(clicked(order, column))}>
              {title}
              {sorted && (order.down ? <ArrowDown size={11} aria-hidden /> : <ArrowUp size={11} aria-hidden />)}
            </button>
          </span>
        );
      })}
    </div>
  );
}
