// All commands; where two share a key, the first that is enabled has it, so those of a stage come before the general,
// and putting a tool down before letting the selection go.
import type { Command } from "./command";
import { demonstrating } from "./demonstrating";
import { going } from "./going";
import { labelling } from "./labelling";
import { learning } from "./learning";
import { reviewing } from "./reviewing";
import { selecting } from "./selecting";
import { viewing } from "./viewing";

export const all: readonly Command[] = [
  ...labelling,
  ...demonstrating,
  ...learning,
  ...reviewing,
  ...going,
  ...viewing,
  ...selecting,
];

/** The command that a key means now. */
export function commandFor(key: string, commands: readonly Command[] = all): Command | undefined {
  return commands.find((command) => command.keys.includes(key) && (command.enabled?.() ?? true));
}
