// What is sensible to do next, in a sentence, and the way there.
import { ArrowRight } from "lucide-react";
import { openAsset, openStage, useDesk } from "../store/desk";
import { useProject } from "../store/project";
import { Button } from "../ui/Button";
import css from "./Side.module.css";

export function NextLine() {
  const next = useProject((state) => state.project.next);
  const there = useDesk((desk) => desk.stage === next.stage && (next.asset === null || desk.asset === next.asset));
  if (!next.say) return null;
  return (
    <div className={css.nextLine} role="status">
      <span className={css.next} aria-hidden />
      <span className={css.say}>{next.say}</span>
      {!there && (
        <Button
          look="quiet"
          icon={ArrowRight}
          tip={next.asset === null ? "Go there" : `Go there: ${next.asset}`}
          keys="Alt+Enter"
          aria-label="Go to what is next"
          onClick={() => {
            openStage(next.stage);
            if (next.asset !== null) openAsset(next.asset);
          }}
        />
      )}
    </div>
  );
}
