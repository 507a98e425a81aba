// Whose limits are looked at.
import { ChevronDown } from "lucide-react";
import { setChecks, useDesk } from "../../../store/desk";
import { useProject } from "../../../store/project";
import { Button } from "../../../ui/Button";
import { Menu } from "../../../ui/Menu";
import css from "./checks.module.css";

export function EngineMenu() {
  const engine = useDesk((desk) => desk.checks.engine);
  const engines = useProject((state) => state.engines);
  const title = engines.find(({ name }) => name === engine)?.title ?? "no engine";
  return (
    <Menu
      trigger={
        <Button className={css.engine} aria-label={`Limits of ${title}`}>
          {title}
          <ChevronDown size={13} aria-hidden />
        </Button>
      }
      lines={[{ name: "", title: "No engine" }, ...engines].map((one) => ({
        label: one.name === engine ? `✓ ${one.title}` : one.title,
        onSelect: () => setChecks({ engine: one.name }),
      }))}
    />
  );
}
