// Goals on one result: the picture of what fails, the sentence, what is at fault, and the answer to it.
import { Check, CircleAlert, CircleCheck } from "lucide-react";
import { acceptGoals } from "../../commands/review";
import { api } from "../../server/api";
import { selectInOutput } from "../../store/checks";
import { goalText } from "../../store/goals";
import { useProject } from "../../store/project";
import { isUpToDate } from "../../store/reviews";
import { countText } from "../../store/words";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import type { GoalResultView } from "../../wire";
import { EnlargeablePicture } from "./CheckPictures";
import css from "./goals.module.css";
import review from "./review.module.css";

/** What is known of the goals on the result of an asset; nothing where the project has none. */
export function GoalsOfAsset({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  if (!card?.goals.length || card.output === "none") return null;
  const fail = card.goals.filter(({ outcome }) => outcome === "failed" || outcome === "broken");
  const others = card.goals.filter((goal) => !fail.includes(goal));
  const open = fail.filter((goal) => goal.fails).length;
  return (
    <Section title="Goals" aside={open > 0 && <span className={review.bad}>✗ {open === 1 ? "one fails" : `${open} fail`}</span>}>
      <GoalFailures asset={asset} goals={fail} />
      {open > 0 && (
        <Button
          icon={Check}
          disabled={!isUpToDate(card)}
          tip="The result is right though this fails: for these goals and this output"
          onClick={() => void acceptGoals(asset)}
        >
          Accept it all the same
        </Button>
      )}
      {others.map((goal) => (
        <p key={goal.name} className={goal.outcome === "passed" ? review.good : review.dim}>
          {goal.outcome === "passed" && "✓ "}
          {goal.name} {goalText(goal)}
        </p>
      ))}
    </Section>
  );
}

/** The picture of a failure, if there is one. */
export function GoalPicture({ asset, goal }: { asset: string; goal: GoalResultView }) {
  return goal.picture && <EnlargeablePicture source={api.goalPicture(asset, goal.picture)} text={`${goal.name} ${goalText(goal)}`} />;
}

/** Goals that fail on a result, each with its picture first; a click on the sentence shows the hulls at fault. */
function GoalFailures({ asset, goals }: { asset: string; goals: readonly GoalResultView[] }) {
  return goals.map((goal) => {
    const Icon = goal.accepted ? CircleCheck : CircleAlert;
    const words = (
      <>
        <Icon size={15} aria-hidden />
        <span>
          {goal.name} {goalText(goal)}
          {goal.before === "failed" && <span className={review.dim}> · as before the edit</span>}
        </span>
      </>
    );
    return (
      <div key={goal.name} className={css.failure} data-open={goal.fails}>
        <GoalPicture asset={asset} goal={goal} />
        {goal.hulls.length ? (
          <button type="button" className={review.finding} title={`Select ${countText(goal.hulls.length, "hull")} at fault`} onClick={() => selectInOutput(asset, goal.hulls)}>
            {words}
          </button>
        ) : (
          <div className={review.finding}>{words}</div>
        )}
      </div>
    );
  });
}
