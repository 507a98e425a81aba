// The review stage: apply the program, look at what came of it, accept, flag, correct, export.
import { useState } from "react";
import { Choice } from "../../ui/Choice";
import { ApplySection } from "./ApplySection";
import { AssetReview } from "./AssetReview";
import { ExportSection } from "./ExportSection";
import { Results } from "./Results";
import css from "./review.module.css";

const PARTS = [
  { value: "asset", label: "This asset" },
  { value: "all", label: "All results" },
  { value: "export", label: "Export" },
] as const;
type Part = (typeof PARTS)[number]["value"];

export function ReviewPanel() {
  const [part, setPart] = useState<Part>("asset");
  return (
    <div className={css.panel}>
      <ApplySection />
      <div className={css.parts}>
        <Choice name="What to review" value={part} options={PARTS} onChange={setPart} />
      </div>
      <div className={css.part} data-part={part}>
        {part === "asset" && <AssetReview />}
        {part === "all" && <Results onOpen={() => setPart("asset")} />}
        {part === "export" && <ExportSection />}
      </div>
    </div>
  );
}
