// The right column: the four stages, what is next, the panel of the stage, the list of hulls.
import { ArrowRight } from "lucide-react";
import { Tabs } from "radix-ui";
import { type ComponentType, useRef } from "react";
import { DemonstratePanel } from "../panels/demonstrate/DemonstratePanel";
import { LabelPanel } from "../panels/label/LabelPanel";
import { LearnPanel } from "../panels/learn/LearnPanel";
import { UpCard } from "../panels/questions/UpCard";
import { ReviewPanel } from "../panels/review/ReviewPanel";
import { nextText, useIsThere } from "../store/nextStep";
import { useProject } from "../store/project";
import { NAMES } from "../commands/command";
import { goToNext } from "../commands/navigate";
import { openStage, setLayout, STAGE_OF, type StageName, STAGES, useLayout, useWorkspace } from "../store/workspace";
import { HullList } from "../hulls/HullList";
import { Divider } from "../ui/Divider";
import css from "./Side.module.css";

const PANELS: Readonly<Record<StageName, ComponentType>> = { label: LabelPanel, demonstrate: DemonstratePanel, learn: LearnPanel, review: ReviewPanel };

export function StageColumn() {
  const stage = useWorkspace((workspace) => workspace.stage);
  const next = useProject((state) => STAGE_OF[state.project.next.kind]);
  return (
    <Tabs.Root className={css.side} value={stage} onValueChange={(value) => openStage(value as StageName)}>
      <Tabs.List className={css.tabs} aria-label="Stages" data-tour="stages">
        {STAGES.map((name, k) => (
          <Tabs.Trigger
            key={name}
            value={name}
            className={css.tab}
            title={`${NAMES[name]} (Alt+${k + 1})${name === next ? "; this is next" : ""}`}
          >
            <span className={css.number} data-next={name === next}>
              {k + 1}
            </span>
            {NAMES[name]}
            {name === next && <span className="visually-hidden">, next</span>}
          </Tabs.Trigger>
        ))}
      </Tabs.List>
      <NextLine />
      <UpCard />
      {STAGES.map((name) => (
        <Tabs.Content key={name} value={name} className={css.content} tabIndex={-1}>
          <Panel stage={name} />
        </Tabs.Content>
      ))}
    </Tabs.Root>
  );
}

/** The panel of a stage; where hulls are picked, with the list of them below. */
function Panel({ stage }: { stage: StageName }) {
  const box = useRef<HTMLDivElement>(null);
  const split = useLayout((layout) => layout.split);
  const Own = PANELS[stage];
  if (stage === "learn" || stage === "review") {
    return (
      <div className={css.panel}>
        <Own />
      </div>
    );
  }
  return (
    <div className={css.halves} ref={box}>
      <div className={css.panel} style={{ flex: `${split} 1 0` }}>
        <Own />
      </div>
      <Divider
        name="Height of the panel"
        along="y"
        value={split}
        range={[0.15, 0.85]}
        unit={() => 1 / (box.current?.clientHeight || 1)}
        onChange={(share) => setLayout({ split: share })}
      />
      <div className={css.list} style={{ flex: `${1 - split} 1 0` }} data-part data-tour="hulls">
        <HullList />
      </div>
    </div>
  );
}

/** What is sensible to do next, in a sentence, which is the button that leads there; or what is being done. */
function NextLine() {
  const text = useProject(nextText);
  const there = useIsThere();
  if (!text) return null;
  return (
    <div role="status">
      <button type="button" className={css.nextLine} disabled={there} aria-keyshortcuts="Alt+Enter" onClick={() => void goToNext()}>
        <span className={css.next} aria-hidden />
        <span className={css.say}>{text}</span>
        {!there && (
          <>
            <kbd>Alt+Enter</kbd> <ArrowRight size={15} aria-hidden />
          </>
        )}
      </button>
    </div>
  );
}
