// Buttons, with words or as an icon; every icon has a name for screen readers and a tooltip.
import type { LucideIcon } from "lucide-react";
import { Tooltip } from "radix-ui";
import type { ButtonHTMLAttributes, ReactNode, Ref } from "react";
import css from "./ui.module.css";

interface ButtonProps extends ButtonHTMLAttributes<HTMLButtonElement> {
  ref?: Ref<HTMLButtonElement>;
  look?: "plain" | "primary" | "quiet" | "danger";
  icon?: LucideIcon;
  tip?: string;
  keys?: string | undefined;
  children?: ReactNode;
}

export function Button({ look = "plain", icon: Icon, tip, keys, children, className, ...rest }: ButtonProps) {
  const button = (
    <button type="button" {...rest} className={[css.button, css[look], className].filter(Boolean).join(" ")}>
      {Icon && <Icon size={15} aria-hidden />}
      {children}
    </button>
  );
  return tip ? (
    <Tip text={tip} keys={keys}>
      {button}
    </Tip>
  ) : (
    button
  );
}

interface IconButtonProps extends ButtonHTMLAttributes<HTMLButtonElement> {
  icon: LucideIcon;
  /** What it does: its name and its tooltip. */
  name: string;
  keys?: string | undefined;
  /** Whether it is switched on; left out where it is no switch. */
  on?: boolean;
}

export function IconButton({ icon: Icon, name, keys, on, className, ...rest }: IconButtonProps) {
  return (
    <Tip text={name} keys={keys}>
      <button type="button" aria-label={name} aria-pressed={on} {...rest} className={[css.iconButton, className].filter(Boolean).join(" ")}>
        <Icon size={16} aria-hidden />
      </button>
    </Tip>
  );
}

/** A tooltip: what a control does, and its key. */
export function Tip({ text, keys, children }: { text: string; keys?: string | undefined; children: ReactNode }) {
  return (
    <Tooltip.Root>
      <Tooltip.Trigger asChild>{children}</Tooltip.Trigger>
      <Tooltip.Portal>
        <Tooltip.Content className={css.tip} sideOffset={5} collisionPadding={6}>
          {text} {keys && <kbd>{keys}</kbd>}
        </Tooltip.Content>
      </Tooltip.Portal>
    </Tooltip.Root>
  );
}
