// The replies to the question whether a result is right; after "wrong", what is right.
import { Check, CircleDot, MousePointer2, Tag, X } from "lucide-react";
import { useState } from "react";
import { demonstrate } from "../../commands/learn";
import { canBeRight, correctSelection, putOff, reply, showAsked } from "../../commands/question";
import { useProject } from "../../store/project";
import { countText } from "../../store/words";
import { openAsset, openStage, useWorkspace, visit } from "../../store/workspace";
import type { ReviewQuestionView } from "../../wire";
import { ExcludeMenu } from "./ExcludeMenu";
import { useCardKeys } from "./cardKeys";
import css from "./questions.module.css";
import { LaterReply, Reply, ShowReply } from "./Replies";

export function ResultReplies({ question }: { question: ReviewQuestionView }) {
  const { asset, choices, goals } = question;
  const asks = canBeRight(question);
  const has = (id: string) => choices.some((choice) => choice.id === id);
  const [wrong, setWrong] = useState(!asks);
  const right = () => void reply(question, { choice: "right" });
  const tell = async (next: () => void) => {
    if (!asks || (await reply(question, { choice: "wrong" }))) next(); // it was told before where it is asked again
  };
  const reject = () => {
    if (wrong) return void tell(() => demonstrate(asset));
    setWrong(true);
    visit(asset, { kind: "source" }); // where hulls can be selected that a rule should have taken
  };
  // Enter and blue are for what is likely: a result that is held for wrong, or fails a goal, is never accepted by the way
  const isLikely = useProject((state) => (state.confidence[asset]?.probability ?? 0) >= 0.5) && !goals.length;
  const [later, show] = [() => void putOff(question), () => showAsked(question)];
  const doing = useCardKeys({ later, show, ...(asks && { choices: [right, reject], accept: right, hasDefault: isLikely }), ...(has("wrong") && { reject }) });
  return (
    <>
      {wrong && has("wrong") && <WhatIsRight question={question} tell={(next) => void tell(next)} />}
      <div className={css.row}>
        {asks && (
          <Reply keyName="Y" look={wrong || !isLikely ? "plain" : "primary"} icon={Check} onClick={doing(right)}>
            {goals.length ? "Accept it all the same" : "Right"}
          </Reply>
        )}
        {!wrong && (
          <Reply keyName="N" icon={X} tip="Then say what is right, if you like" onClick={doing(reject)}>
            Wrong
          </Reply>
        )}
        <ExcludeMenu onPick={(id) => void reply(question, { choice: id })} />
        <ShowReply onClick={doing(show)} />
        <LaterReply onClick={doing(later)} />
      </div>
    </>
  );
}

/** The ways to say what is right: other hulls for a rule, other labels, a demonstration; or nothing more. */
function WhatIsRight({ question, tell }: { question: ReviewQuestionView; tell: (next: () => void) => void }) {
  const { asset } = question;
  const runs = useProject((state) => state.reach[asset]?.error == null);
  const rules = useProject((state) => state.program.rules);
  const isOpen = useWorkspace((state) => state.asset === asset && state.showing.kind === "source");
  const count = useWorkspace((state) => state.selection.size);
  const label = () => {
    openAsset(asset);
    openStage("label");
  };
  return (
    <div className={css.ways} role="group" aria-label="What is right">
      <p>What is right?{runs && " Select the hulls that a rule should take, or:"}</p>
      {(runs ? rules : []).map(({ rule, sentence }) => (
        <Reply
          key={rule}
          icon={MousePointer2}
          tip={isOpen ? `${sentence} Here it should take the ${countText(count, "hull")} selected in the view` : "Show the asset, and select hulls"}
          onClick={isOpen ? () => void correctSelection(question, rule) : () => visit(asset, { kind: "source" })}
        >
          Select other hulls for rule {rule}
          {isOpen && <span className={css.facts}>{count ? countText(count, "hull") : "no hull"}</span>}
        </Reply>
      ))}
      <Reply icon={Tag} tip="Opens the asset, to label its hulls" onClick={() => tell(label)}>
        Labels are wrong
      </Reply>
      <Reply keyName="N" icon={CircleDot} tip="Opens the asset, to demonstrate the edit on it" onClick={() => tell(() => demonstrate(asset))}>
        Show it
      </Reply>
      {canBeRight(question) && (
        <Reply icon={X} tip="It needs review until somebody says what is right" onClick={() => tell(() => undefined)}>
          Just wrong
        </Reply>
      )}
    </div>
  );
}
