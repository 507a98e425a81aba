// The actions of the language, each with its key.
import { ACTION_KEYS } from "../../commands/demonstrating";
import { inTurn } from "../../commands/turns";
import { startDraft } from "../../store/beginning";
import { actionIcon } from "../../steps/actionLooks";
import type { ActionForm } from "../../wire";
import { Tip } from "../../ui/Tip";
import css from "./demonstrate.module.css";

export function ActionChoice({ forms, action }: { forms: readonly ActionForm[]; action: string | null }) {
  return (
    <div className={css.actions} role="group" aria-label="Action">
      {forms.map(({ name, summary }) => {
        const Icon = actionIcon(name);
        return (
          <Tip key={name} text={summary} keys={ACTION_KEYS[name]}>
            <button
              type="button"
              className={css.action}
              aria-pressed={action === name}
              onClick={() => inTurn(() => startDraft(name))}
            >
              <Icon size={17} aria-hidden />
              {name}
              <kbd aria-hidden>{(ACTION_KEYS[name] ?? "").replace("Shift+", "⇧")}</kbd>
            </button>
          </Tip>
        );
      })}
    </div>
  );
}
