// The button that learns, and how learning stands in words.
import { Check, CircleAlert, CircleHelp, GraduationCap, LoaderCircle, Square } from "lucide-react";
import { learnNow, stopLearning } from "../../commands/learning";
import { lessonSummary, type Summary } from "../../store/lessons";
import { readable, useProject } from "../../store/project";
import { Button } from "../../ui/Button";
import css from "./learn.module.css";

export function LearnHead() {
  const learning = useProject((state) => state.learning);
  const wanted = useProject(({ lesson }) => !lesson || lesson.status === "timeout" || lesson.status === "error");
  const taught = useProject((state) => state.project.rules.length > 0);
  return (
    <section className={css.head} aria-label="Learning">
      <State />
      {learning ? (
        <Button icon={Square} onClick={() => void stopLearning()}>
          Stop
        </Button>
      ) : (
        <Button
          look={wanted ? "primary" : "plain"}
          icon={GraduationCap}
          disabled={!taught}
          tip={taught ? "Learn the program from all that was shown and said" : "Show the steps on an asset first"}
          keys="Ctrl+Enter"
          onClick={() => void learnNow()}
        >
          Learn
        </Button>
      )}
    </section>
  );
}

function State() {
  const lesson = useProject((state) => state.lesson);
  const learning = useProject((state) => state.learning);
  const assets = useProject((state) => readable(state.cards));
  const said = lessonSummary(lesson, assets);
  const Icon = learning ? LoaderCircle : ICONS[said.mood];
  return (
    <div className={css.state} data-mood={learning ? "plain" : said.mood} role="status">
      <Icon size={18} aria-hidden className={learning ? css.spinning : undefined} />
      <div>
        <strong>{learning ? "Learning…" : said.title}</strong>
        {said.more && <p>{learning ? "What stands below is from before." : said.more}</p>}
      </div>
    </div>
  );
}

const ICONS: Record<Summary["mood"], typeof Check> = {
  plain: GraduationCap,
  good: Check,
  warn: CircleHelp,
  bad: CircleAlert,
};
