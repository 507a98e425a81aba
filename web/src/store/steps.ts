// The steps of an asset, and the changes to them, each one edit.
import type { AssetView, StepText, StepView } from "../wire";
import type { Draft } from "./desk";
import { openPlaces } from "./drafts";
import { perform } from "./edits";
import { details } from "./scenes";
import { useProject } from "./project";

type Change = (steps: readonly StepText[]) => readonly StepText[];

/** How long to wait for the news of a change that was made [ms]. */
const NEWS = 1000;

/** Changes the steps of an asset as they are on the server now; done once the page knows of it, too. */
export async function changeSteps(asset: string, change: Change): Promise<boolean> {
  const { view } = await details(asset);
  const news = changed(asset);
  const done = await perform({ kind: "steps", asset, version: view.version, steps: [...change(texts(view.steps))] });
  if (done) await Promise.race([news.arrived, new Promise((late) => setTimeout(late, NEWS))]);
  news.stop();
  return done;
}

/** The next time that the server says that an asset changed. */
function changed(asset: string): { arrived: Promise<void>; stop: () => void } {
  let stop = (): void => undefined;
  const arrived = new Promise<void>((arrive) => {
    stop = useProject.subscribe((now, before) => {
      if (now.revisions[asset] !== before.revisions[asset]) arrive();
    });
  });
  return { arrived, stop };
}

export const texts = (steps: readonly StepView[]): StepText[] =>
  steps.map(({ select, action }) => ({ select, action }));

/** Shows a rule on an asset: in place `at` (from 0), the rules before it left open where nothing is said yet. */
export function shown(at: number, step: StepText): Change {
  return (steps) => {
    const filled = [...steps];
    while (filled.length < at) filled.push({ select: null, action: actionOf(filled.length) });
    filled[at] = step;
    return filled;
  };
}

/** What the rule in a place (from 0) does, as other assets show it. */
export function actionOf(place: number): string {
  return useProject.getState().project.rules[place]?.action ?? "Delete";
}

export const takenAway =
  (at: number): Change =>
  (steps) =>
    at === steps.length - 1 ? steps.slice(0, at) : steps.map((s, k) => (k === at ? { ...s, select: null } : s));

/** The text of an action as the language has it. */
export function draftText(draft: Draft, order: readonly { name: string; kind: string }[]): string {
  const words = order.flatMap(({ name, kind }) => {
    const value = draft.arguments[name];
    if (value === undefined || value === "" || value === false) return [];
    if (kind === "flag") return [name];
    const isWord = kind !== "file" && (kind !== "shape" || PRIMITIVES.has(String(value)));
    return [isWord ? String(value) : JSON.stringify(value)];
  });
  const plain = words.length ? `${draft.action}(${words.join(", ")})` : draft.action;
  const whole = draft.each ? `Each(${plain})` : plain;
  return draft.label ? `${whole} as ${labelText(draft.label)}` : whole;
}

export const PRIMITIVES: ReadonlySet<string> = new Set(["box", "cylinder", "capsule", "sphere"]);

const RESERVED = new Set("All Is Attach Geo Union Intersect Diff Delete Replace Add Merge Scale Each".split(" "));

/** A label as programs write it: quoted where it is no single word, or a word of the language. */
export function labelText(label: string): string {
  return /^[\p{L}_][\p{L}\p{N}_]*$/u.test(label) && !RESERVED.has(label) ? label : JSON.stringify(label);
}

/** Places (from 0) of the family's rules that an asset says nothing about yet. */
export const openRules = (view: AssetView): number[] => openPlaces(useProject.getState().project.rules, view);
