// Light, dark, or as the system has it.
import { Monitor, Moon, Sun } from "lucide-react";
import { type DeskState, useDesk } from "../store/desk";
import { IconButton } from "../ui/Button";
import { Menu } from "../ui/Menu";

type Theme = DeskState["theme"];
const WORDS: Readonly<Record<Theme, string>> = { light: "Light", dark: "Dark", system: "As the system" };
const ICONS = { light: Sun, dark: Moon, system: Monitor } as const;

export function ThemeMenu() {
  const theme = useDesk((desk) => desk.theme);
  return (
    <Menu
      trigger={<IconButton icon={ICONS[theme]} name={`Theme: ${WORDS[theme].toLowerCase()}`} />}
      lines={(["light", "dark", "system"] as const).map((value) => ({
        label: value === theme ? `✓ ${WORDS[value]}` : WORDS[value],
        onSelect: () => useDesk.setState({ theme: value }),
      }))}
    />
  );
}
