// Small signs on a card, each a shape of its own with its words behind it.
import {
  Check,
  CircleAlert,
  CircleDashed,
  CircleDot,
  Flag,
  Hand,
  type LucideIcon,
  Pencil,
  RefreshCw,
  Tag,
  TriangleAlert,
} from "lucide-react";
import { useDesk } from "../store/desk";
import type { Card } from "../wire";
import css from "./card.module.css";
import { type Badge, badges, fitting } from "./words";

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
  findings: TriangleAlert,
};

/** room: for signs and their counts [px]. */
export function Badges({ card, room }: { card: Card; room: number }) {
  const engine = useDesk((desk) => desk.checks.engine);
  const { shown, rest } = fitting(badges(card, engine), room);
  return (
    <span className={css.badges}>
      {shown.map(({ name, text, count, old }) => {
        const Icon = ICONS[name];
        return (
          <span key={name} className={css.badge} data-badge={name} data-old={old} title={text}>
            <Icon size={12} aria-hidden />
            {count}
          </span>
        );
      })}
      {rest.length > 0 && (
        <span className={css.badge} title={rest.map((badge) => badge.text).join("\n")}>
          +{rest.length}
        </span>
      )}
    </span>
  );
}
