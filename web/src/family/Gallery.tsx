// The family in place of the view, with larger pictures.
import { Outcome } from "../outcome/Outcome";
import { Cards } from "./Cards";
import css from "./family.module.css";
import { FamilyHead } from "./FamilyHead";
import { Filters } from "./Filters";
import { NeedHulls } from "./NeedHulls";
import { Reading } from "./Reading";

export function Gallery() {
  return (
    <div className={[css.family, css.gallery].join(" ")} data-tour="family">
      <FamilyHead />
      <Reading />
      <NeedHulls />
      <Filters />
      <div className={css.outcome}>
        <Outcome />
      </div>
      <Cards least={216} large />
    </div>
  );
}
