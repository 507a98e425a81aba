// Small signs on a card, each a shape of its own with its words behind it.
import { Check, CircleAlert, Flag, Hand, Pencil, RefreshCw, Tag, CircleDot, type LucideIcon, CircleDashed } from "lucide-react";
import type { Card } from "../wire";
import css from "./card.module.css";
import { type Badge, badges } from "./words";

export const ICONS: Readonly<Record<Badge["name"], LucideIcon>> = {
  unlabelled: Tag,
  unsure: CircleDashed,
  demonstrated: CircleDot,
  edited: Pencil,
  stale: RefreshCw,
  accepted: Check,
  flagged: Flag,
  failed: CircleAlert,
  corrected: Hand,
};

export function Badges({ card }: { card: Card }) {
  return (
    <span className={css.badges}>
      {badges(card).map(({ name, text, count }) => {
        const Icon = ICONS[name];
        return (
          <span key={name} className={css.badge} data-badge={name} title={text}>
            <Icon size={12} aria-hidden />
            {count}
          </span>
        );
      })}
    </span>
  );
}
