// Commands as the help lists them: those that differ in a number only share a line.

interface Line {
  id: string;
  title: string;
  keys: readonly string[];
}

/** Folds neighbours such as `Label 1: …`, `Label 2: …` into `Label 1 to 2: …`. */
export function folded(commands: readonly Line[]): readonly Line[] {
  const runs: Line[][] = [];
  for (const command of commands) {
    const run = runs.at(-1);
    if (run?.[0] && /\d/.test(command.title) && pattern(run[0]) === pattern(command)) run.push(command);
    else runs.push([command]);
  }
  return runs.flatMap(whole);
}

const pattern = ({ title }: Line) => title.replace(/\d+/, "#");
const number = ({ title }: Line) => /\d+/.exec(title)?.[0] ?? "";

function whole(run: readonly Line[]): readonly Line[] {
  const [first, last] = [run[0], run.at(-1)];
  if (!first || !last || run.length < 3) return run;
  const title = first.title.replace(/\d+/, `${number(first)} to ${number(last)}`);
  return [{ id: first.id, title, keys: [...first.keys.slice(0, 1), "…", ...last.keys.slice(0, 1)] }];
}
