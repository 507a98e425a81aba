// The choice of a theme.
import { Monitor, Moon, Sun } from "lucide-react";
import { useWorkspace, type WorkspaceState } from "../store/workspace";
import { IconButton } from "./Button";
import { choiceLines, Menu } from "./Menu";

type Theme = WorkspaceState["theme"];
const THEME_NAMES: Readonly<Record<Theme, string>> = { light: "Light", dark: "Dark", system: "Like the system" };
const ICONS = { light: Sun, dark: Moon, system: Monitor } as const;

/** Theme: light, dark, or like the system has it. */
export function ThemeMenu() {
  const theme = useWorkspace((workspace) => workspace.theme);
  return (
    <Menu
      trigger={<IconButton icon={ICONS[theme]} name={`Theme: ${THEME_NAMES[theme].toLowerCase()}`} />}
      lines={choiceLines(THEME_NAMES, theme, (value) => useWorkspace.setState({ theme: value }))}
    />
  );
}
