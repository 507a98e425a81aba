// One way to get labels: where they come from, what it would give, and the button that does it.
import type { LucideIcon } from "lucide-react";
import type { ReactNode } from "react";
import css from "./ways.module.css";

interface WayProps {
  icon: LucideIcon;
  title: string;
  /** What it would give, or why it gives nothing. */
  text: ReactNode;
  action: ReactNode;
  /** What there is more to tell, below. */
  children?: ReactNode;
}

export function Way({ icon: Icon, title, text, action, children }: WayProps) {
  return (
    <li className={css.way}>
      <Icon size={16} aria-hidden className={css.sign} />
      <div className={css.words}>
        <span className={css.title}>{title}</span>
        <span className={css.text}>{text}</span>
      </div>
      {action}
      {children && <div className={css.more}>{children}</div>}
    </li>
  );
}
