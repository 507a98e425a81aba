// The bar over the picture: tools and selecting on the first line, looking on the second.
import { lazy, Suspense } from "react";
import { useScenes } from "../../store/scenes";
import { firstPicture } from "../firstPicture";
import { ColorChoice } from "./ColorChoice";
import { CompareChoice } from "./CompareChoice";
import { ExplodeSlide } from "./ExplodeSlide";
import { SelectionMenu } from "./SelectionMenu";
import { ShowingMenu } from "./ShowingMenu";
import { Switches } from "./Switches";
import css from "./toolbar.module.css";
import { Tools } from "./Tools";
import { ViewMenu } from "./ViewMenu";

/** Its editor takes longer to begin than the picture, so it comes after it. */
const ExtractorField = lazy(async () => {
  await firstPicture();
  return { default: (await import("../../text/ExtractorField")).ExtractorField };
});

export function Toolbar() {
  const there = useScenes(({ scene }) => scene !== null);
  return (
    <div className={css.bar} role="toolbar" aria-label="View" inert={!there}>
      <div className={css.line}>
        <Tools />
        <SelectionMenu />
        <Suspense fallback={<div className={css.field} />}>
          <ExtractorField />
        </Suspense>
      </div>
      <div className={css.line}>
        <ShowingMenu />
        <CompareChoice />
        <span className={css.gap} />
        <ColorChoice />
        <Switches />
        <ExplodeSlide />
        <ViewMenu />
      </div>
    </div>
  );
}
