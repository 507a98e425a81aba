// The left column: how many assets there are, what to show of them, and the cards.
import { useProject } from "../store/project";
import { Cards } from "./Cards";
import css from "./family.module.css";
import { FamilyHead } from "./FamilyHead";
import { Filters } from "./Filters";
import { NeedHulls } from "./NeedHulls";
import { Reading } from "./Reading";

export function Family() {
  const any = useProject((state) => state.order.length > 0);
  return (
    <div className={css.family}>
      <FamilyHead />
      <Reading />
      {any && (
        <>
          <NeedHulls />
          <Filters />
          <Cards least={112} />
        </>
      )}
    </div>
  );
}
