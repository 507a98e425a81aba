// The button that gives an asset up, with its two reasons.
import { Ban } from "lucide-react";
import { Button } from "../../ui/Button";
import { Menu } from "../../ui/Menu";

const LINES = [
  ["not-of-family", "Not of this family: not edited, not counted"],
  ["not-solved", "Not solved: counted, and not written"],
] as const;

export function ExcludeMenu({ onPick }: { onPick: (id: (typeof LINES)[number][0]) => void }) {
  return (
    <Menu
      trigger={
        <Button look="quiet" icon={Ban}>
          Exclude
        </Button>
      }
      lines={LINES.map(([id, label]) => ({ label, onSelect: () => onPick(id) }))}
    />
  );
}
