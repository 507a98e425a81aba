// Before and after: off, with a line between them, or side by side.
import { Columns2, Square, SquareSplitHorizontal } from "lucide-react";
import { type Compare, setView, useDesk } from "../../store/desk";
import { useScenes } from "../../store/scenes";
import { Choice } from "../../ui/Choice";

const OPTIONS: readonly { value: Compare; icon: typeof Square; name: string }[] = [
  { value: "off", icon: Square, name: "No comparison" },
  { value: "slider", icon: SquareSplitHorizontal, name: "Before and after with a line between them" },
  { value: "side", icon: Columns2, name: "Before and after side by side" },
];

export function CompareChoice() {
  const compare = useDesk((desk) => desk.view.compare);
  const edited = useScenes(({ scene }) => scene?.edit != null);
  if (!edited) return null;
  return (
    <Choice
      name="Compare with the asset as it comes"
      value={compare}
      options={OPTIONS.map(({ value, icon: Icon, name }) => ({ value, name, label: <Icon size={15} aria-hidden /> }))}
      onChange={(value) => setView({ compare: value })}
    />
  );
}
