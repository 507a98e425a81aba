// The picture of each action.
import { Combine, type LucideIcon, Minimize2, PackagePlus, Replace, Scaling, Shapes, Trash2 } from "lucide-react";
import type { ActionView } from "../wire";

export const ACTION_ICONS: Readonly<Record<ActionView["icon"], LucideIcon>> = {
  delete: Trash2,
  replace: Replace,
  add: PackagePlus,
  merge: Combine,
  scale: Scaling,
  shrink: Minimize2,
  shapes: Shapes,
};
