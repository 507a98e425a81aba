// All commands; where two share a key, the first that is enabled has it, so those of a stage come before the general.
import type { Command } from "./command";
import { demonstrating } from "./demonstrating";
import { going } from "./going";
import { labelling } from "./labelling";
import { learning } from "./learning";
import { reviewing } from "./reviewing";

const others = import.meta.glob<Record<string, readonly Command[]>>(["./selecting.ts", "./viewing.ts"], { eager: true });

export const all: readonly Command[] = [
  ...labelling,
  ...demonstrating,
  ...learning,
  ...reviewing,
  ...going,
  ...Object.entries(others).flatMap(([path, module]) => module[path.slice(2, -3)] ?? []),
];

/** The command that a key means now. */
export function commandFor(key: string, commands: readonly Command[] = all): Command | undefined {
  return commands.find((command) => command.keys.includes(key) && (command.enabled?.() ?? true));
}
