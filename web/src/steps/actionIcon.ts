// The picture of each action.
import { Combine, type LucideIcon, Minimize2, PackagePlus, Replace, Scaling, Shapes, Trash2 } from "lucide-react";

const ICONS: Readonly<Record<string, LucideIcon>> = {
  Delete: Trash2,
  Replace,
  Add: PackagePlus,
  Merge: Combine,
  Scale: Scaling,
  Shrink: Minimize2,
};

/** The icon of an action, by its name or by the text of a step. */
export function actionIcon(text: string): LucideIcon {
  const name = /^(?:Each\()?(\w+)/.exec(text)?.[1] ?? "";
  return ICONS[name] ?? Shapes;
}
