// The key of a command, as tooltips and menus show it, and a way to run one by its name.
import type { Command } from "../../commands/command";
import { measureCommands } from "../../commands/measure";
import { selectCommands } from "../../commands/select";
import { viewCommands } from "../../commands/view";
import type { MenuLine } from "../../ui/Menu";

const commands = new Map([...selectCommands, ...viewCommands, ...measureCommands].map((command) => [command.id, command]));

/** A command of this room by its id. */
function commandOf(id: string): Command {
  const command = commands.get(id);
  if (!command) throw new RangeError(`there is no command ${id}`);
  return command;
}

/** A button that runs a command, with its key. */
export function runs(id: string): { keys: string | undefined; onClick: () => void } {
  const { keys, run } = commandOf(id);
  return { keys: keys[0], onClick: () => void run() };
}

/** Commands as lines of a menu, disabled where they make no sense now. */
export function linesOf(ids: readonly string[]): MenuLine[] {
  return ids.map((id) => {
    const { title, keys, enabled, run } = commandOf(id);
    return { label: title, keys: keys[0], disabled: !(enabled?.() ?? true), onSelect: run };
  });
}
