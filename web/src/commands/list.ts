// All commands: which one a key means, and how the help and the palette list them.
import { useProject } from "../store/project";
import { openAsset } from "../store/workspace";
import type { Command } from "./command";
import { demonstrateCommands, listActionCommands } from "./demonstrate";
import { goCommands } from "./navigate";
import { labelCommands } from "./label";
import { learnCommands } from "./learn";
import { measureCommands } from "./measure";
import { questionCommands } from "./question";
import { reviewCommands } from "./review";
import { selectCommands } from "./select";
import { memberCommands, sheetCommands } from "./sheet";
import { viewCommands } from "./view";

const begin: readonly Command[] = [...labelCommands, ...sheetCommands];
const others: readonly Command[] = [
  ...demonstrateCommands,
  ...learnCommands,
  ...questionCommands,
  ...reviewCommands,
  ...goCommands,
  ...memberCommands,
  ...viewCommands,
  ...measureCommands,
  ...selectCommands,
];

/** All commands; an action of a plug-in has no key where a command has that. */
export function listCommands(): readonly Command[] {
  const taken = new Set([...begin, ...others].flatMap(({ keys }) => keys));
  const actions = listActionCommands().map((one) => ({ ...one, keys: one.keys.filter((key) => !taken.has(key)) }));
  return [...begin, ...actions, ...others];
}

/** The command that a key means now. */
export function commandFor(key: string, commands: readonly Command[] = listCommands()): Command | undefined {
  return commands.find((command) => command.keys.includes(key) && (command.enabled?.() ?? true));
}

type HelpLine = Pick<Command, "id" | "title" | "keys">;

/** Folds neighbours such as `Label 1: …`, `Label 2: …` into `Label 1 to 2: …`. */
export function foldCommands(commands: readonly HelpLine[]): readonly HelpLine[] {
  const runs: HelpLine[][] = [];
  for (const command of commands) {
    const run = runs.at(-1);
    if (run?.[0] && /\d/.test(command.title) && pattern(run[0]) === pattern(command)) run.push(command);
    else runs.push([command]);
  }
  return runs.flatMap(foldRun);
}

const pattern = ({ title }: HelpLine) => title.replace(/\d+/, "#");
const number = ({ title }: HelpLine) => /\d+/.exec(title)?.[0] ?? "";

function foldRun(run: readonly HelpLine[]): readonly HelpLine[] {
  const [first, last] = [run[0], run.at(-1)];
  if (!first || !last || run.length < 3) return run;
  const title = first.title.replace(/\d+/, `${number(first)} to ${number(last)}`);
  return [{ id: first.id, title, keys: [...first.keys.slice(0, 1), "…", ...last.keys.slice(0, 1)] }];
}

/** Those with every word of the search; where it begins a title, or a word of it, they come first. */
export function rankLines<T extends { title: string; aside: string; words?: string | undefined }>(all: readonly T[], search: string): readonly T[] {
  const words = search.toLowerCase().split(/\s+/).filter(Boolean);
  const [first] = words;
  if (first === undefined) return all;
  const place = ({ title, words: more }: T) => {
    const text = title.toLowerCase();
    if (text.startsWith(first)) return 0;
    return `${text} ${more ?? ""}`.split(/[\s_/-]+/).some((word) => word.startsWith(first)) ? 1 : 2;
  };
  const fits = all.filter(({ title, aside, words: more }) => {
    const text = `${title} ${aside} ${more ?? ""}`.toLowerCase();
    return words.every((word) => text.includes(word));
  });
  return [...fits].sort((a, b) => place(a) - place(b));
}

export interface PaletteLine {
  id: string;
  title: string;
  aside: string;
  keys: string | undefined;
  words?: string | undefined;
  /** Why it cannot be done now, null where it can. */
  reason: string | null;
  run: () => void;
}

/** What the list of commands offers: commands that make sense now, then the others, and assets. */
export function paletteLines(): readonly PaletteLine[] {
  const lines = listCommands()
    .filter((command) => command.id !== "palette")
    .map(({ id, title, group, keys, words, enabled, run }) => ({ id, title, aside: group, keys: keys[0], words, reason: enabled?.reason() ?? null, run }));
  lines.sort((a, b) => Number(a.reason !== null) - Number(b.reason !== null));
  const assets = useProject.getState().order.map((asset) => ({
    id: `asset ${asset}`,
    title: asset,
    aside: "Asset",
    keys: undefined,
    reason: null,
    run: () => openAsset(asset),
  }));
  return [...lines, ...assets];
}
