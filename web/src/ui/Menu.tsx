// A menu that opens from a button.
import { Check } from "lucide-react";
import { DropdownMenu } from "radix-ui";
import { type ReactNode, useRef } from "react";
import css from "./ui.module.css";

export interface MenuLine {
  label: ReactNode;
  keys?: string | undefined;
  disabled?: boolean;
  /** Whether it is what is chosen, where it is a choice. */
  on?: boolean;
  /** Whether keys are for what it begins from then on, and no more for the button of the menu. */
  leaves?: boolean;
  onSelect: () => void;
}

/** A line for each of some values, by their names, of which one is chosen. */
export function choiceLines<T extends string>(names: Readonly<Record<T, ReactNode>>, now: T, onPick: (value: T) => void): MenuLine[] {
  return (Object.keys(names) as T[]).map((value) => ({ label: names[value], on: value === now, onSelect: () => onPick(value) }));
}

/** Not modal, as that hides controls from screen readers that still can take the focus; a shade takes clicks beside it. */
export function Menu({ trigger, lines }: { trigger: ReactNode; lines: readonly (MenuLine | "line")[] }) {
  const leaves = useRef(false);
  const choose = (line: MenuLine) => {
    leaves.current = line.leaves ?? false;
    line.onSelect();
  };
  return (
    <DropdownMenu.Root modal={false} onOpenChange={(open) => open && (leaves.current = false)}>
      <DropdownMenu.Trigger asChild>{trigger}</DropdownMenu.Trigger>
      <DropdownMenu.Portal>
        <section aria-label="Menu">
          <div className={css.menuShade} aria-hidden />
          <DropdownMenu.Content className={css.menu} sideOffset={4} align="end" onCloseAutoFocus={(event) => leaves.current && event.preventDefault()}>
            {lines.map((line, k) =>
              line === "line" ? (
                <DropdownMenu.Separator key={k} className={css.menuLine} />
              ) : (
                <DropdownMenu.Item key={k} className={css.menuItem} disabled={line.disabled ?? false} onSelect={() => choose(line)}>
                  <span className={css.menuLabel} aria-current={line.on}>
                    {line.on !== undefined && <Check size={13} aria-hidden style={{ visibility: line.on ? "visible" : "hidden" }} />}
                    {line.label}
                  </span>
                  {line.keys && <kbd>{line.keys}</kbd>}
                </DropdownMenu.Item>
              ),
            )}
          </DropdownMenu.Content>
        </section>
      </DropdownMenu.Portal>
    </DropdownMenu.Root>
  );
}
