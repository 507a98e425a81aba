// Which rule of the family the action in hand shows: one that other assets show, or a new one.
import type { Draft } from "../../store/desk";
import { changeDraft } from "../../store/drafting";
import { useProject } from "../../store/project";
import { draftText } from "../../store/steps";
import { changeEverywhere } from "../../store/everywhere";
import { listed, shortName } from "../../store/words";
import type { ActionForm } from "../../wire";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { useDesk } from "../../store/desk";
import css from "./demonstrate.module.css";
import { Labelled } from "./Labelled";

export function RulePlace({ draft, form }: { draft: Draft; form: ActionForm }) {
  const rules = useProject((state) => state.project.rules);
  if (!rules.length) return null;
  return (
    <>
      <Labelled name="Rule" inline>
        <select
          className={css.input}
          aria-label="Rule that it shows"
          value={draft.editing ?? "new"}
          onChange={(event) =>
            changeDraft({ editing: event.target.value === "new" ? null : Number(event.target.value) })
          }
        >
          {rules.map((rule, place) => (
            <option key={rule.rule} value={place}>
              {rule.rule}: {rule.action}
            </option>
          ))}
          <option value="new">a new one</option>
        </select>
      </Labelled>
      {draft.editing !== null && <Differs place={draft.editing} text={draftText(draft, form.arguments)} />}
    </>
  );
}

/** A rule does the same everywhere: told where it would not. */
function Differs({ place, text }: { place: number; text: string }) {
  const asset = useDesk((desk) => desk.asset);
  const rule = useProject((state) => state.project.rules[place]);
  const others = rule ? [...rule.shown, ...rule.nothing].filter((other) => other !== asset) : [];
  if (!rule || rule.action === text || !others.length) return null;
  return (
    <Note mood="warn">
      A rule does the same everywhere; on {listed(others.map(shortName), 2)} this one is {rule.action}.
      <div className={css.buttons}>
        <Button onClick={() => changeDraft({ editing: null })}>Make it a new rule</Button>
        <Button onClick={() => void changeEverywhere(others, place, text)}>Change it there, too</Button>
      </div>
    </Note>
  );
}
