// A menu that opens from a button.
import { DropdownMenu } from "radix-ui";
import type { ReactNode } from "react";
import css from "./ui.module.css";

export interface MenuLine {
  label: ReactNode;
  keys?: string | undefined;
  disabled?: boolean;
  onSelect: () => void;
}

/** A line for each of some values, of which one is chosen now. */
export const choiceLines = <Value extends string>(texts: Readonly<Record<Value, string>>, now: Value, choose: (value: Value) => void): MenuLine[] =>
  (Object.keys(texts) as Value[]).map((value) => ({ label: value === now ? `✓ ${texts[value]}` : texts[value], onSelect: () => choose(value) }));

/** Not modal, as that hides controls from screen readers that still can take the focus; a shade takes clicks beside it. */
export function Menu({ trigger, lines }: { trigger: ReactNode; lines: readonly (MenuLine | "line")[] }) {
  return (
    <DropdownMenu.Root modal={false}>
      <DropdownMenu.Trigger asChild>{trigger}</DropdownMenu.Trigger>
      <DropdownMenu.Portal>
        <section aria-label="Menu">
          <div className={css.menuShade} aria-hidden />
          <DropdownMenu.Content className={css.menu} sideOffset={4} align="end">
            {lines.map((line, k) =>
              line === "line" ? (
                <DropdownMenu.Separator key={k} className={css.menuLine} />
              ) : (
                <DropdownMenu.Item key={k} className={css.menuItem} disabled={line.disabled ?? false} onSelect={line.onSelect}>
                  <span>{line.label}</span>
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
