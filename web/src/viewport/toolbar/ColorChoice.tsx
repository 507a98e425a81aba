// By what hulls are coloured.
import { Check, ChevronDown, Palette } from "lucide-react";
import { type ColorBy, setView, useDesk } from "../../store/desk";
import { Button } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import css from "./toolbar.module.css";

const NAMES: Readonly<Record<ColorBy, string>> = {
  label: "Label",
  hull: "Hull",
  confidence: "Confidence",
  body: "Body",
};

export function ColorChoice() {
  const colorBy = useDesk((desk) => desk.view.colorBy);
  return (
    <Menu
      trigger={
        <Button look="quiet" icon={Palette} className={css.small} aria-label={`Colour by ${NAMES[colorBy]}`}>
          {NAMES[colorBy]}
          <ChevronDown size={13} aria-hidden />
        </Button>
      }
      lines={(Object.keys(NAMES) as ColorBy[]).map((value) => ({
        label: (
          <span className={css.labelLine}>
            <Check size={13} aria-hidden style={{ visibility: value === colorBy ? "visible" : "hidden" }} />
            Colour by {NAMES[value].toLowerCase()}
          </span>
        ),
        onSelect: () => setView({ colorBy: value }),
      }))}
    />
  );
}
