// What the learned program would select on the asset in hand, rule by rule, offered one after the other.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Guess } from "../wire";
import { useDesk } from "./desk";
import { draftStep } from "./beginning";
import { useProject } from "./project";
import { isDeclined, isPassedOver, sayStep } from "./saying";
import { details } from "./scenes";
import { openRules } from "./steps";
import { complainedOf } from "./toasts";

interface GuessesState {
  asset: string | null;
  guesses: readonly Guess[];
  loading: boolean;
  /** Why there are none. */
  error: string | null;
}

const none: GuessesState = { asset: null, guesses: [], loading: false, error: null };

export const useGuesses = create<GuessesState>()(() => none);

/** Keeps the guesses in step until the returned function is called, and offers the next one to an empty hand. */
export function followGuesses(): () => void {
  let known = "";
  let fresh = false;
  async function ask(key: string): Promise<void> {
    fresh = false;
    const answer = await asked();
    if (key !== state()) return;
    useGuesses.setState(answer);
    fresh = true;
    await offer();
  }
  function look(): void {
    const key = state();
    if (key === known) return;
    known = key;
    ask(key).catch(complainedOf);
  }
  const stops = [
    useDesk.subscribe((now, before) => {
      look();
      if (fresh && before.draft && !now.draft) offer().catch(complainedOf);
    }),
    useProject.subscribe(look),
  ];
  look();
  return () => {
    stops.forEach((stop) => stop());
    useGuesses.setState(none);
  };
}

/** All that guesses depend on. */
function state(): string {
  const { asset, stage } = useDesk.getState();
  const { revisions, program, lesson } = useProject.getState();
  return JSON.stringify([asset, stage, revisions[asset ?? ""], program.version, lesson?.number]);
}

async function asked(): Promise<Partial<GuessesState>> {
  const { asset, stage } = useDesk.getState();
  const { program, lesson } = useProject.getState();
  if (asset === null || stage !== "demonstrate" || !(program.text || lesson?.program)) return none;
  if (useGuesses.getState().asset !== asset) useGuesses.setState({ ...none, asset, loading: true });
  try {
    const { guesses } = await api.guesses(asset);
    return { ...none, asset, guesses };
  } catch (error) {
    if (!(error instanceof ServerProblem)) throw error;
    return { ...none, asset, error: error.problem.message };
  }
}

/** Puts the guess for the first open rule into the hand, unless that is full or put it down before. */
async function offer(): Promise<void> {
  const { asset, error } = useGuesses.getState();
  if (asset === null || error !== null) return;
  const { view } = await details(asset);
  const place = openRules(view).find((k) => !isDeclined(asset, k));
  if (place === undefined) return;
  const guess = guessFor(place + 1);
  const { asset: now, draft, selection, tool, stage } = useDesk.getState();
  const isFree = now === asset && stage === "demonstrate" && draft === null && !selection.size && tool === "select";
  if (guess?.select.length && isFree && !isPassedOver(asset, place)) await draftStep(place, guess.select);
}

/** The guess for a rule (from 1), where there is a sound one. */
export function guessFor(rule: number): Guess | undefined {
  return useGuesses.getState().guesses.find((guess) => guess.rule === rule && guess.error === null);
}

/** Takes the guess for a rule as the step. */
export async function acceptGuess(rule: number): Promise<void> {
  const { asset } = useGuesses.getState();
  const guess = guessFor(rule);
  if (asset !== null && guess && useDesk.getState().asset === asset)
    await sayStep(asset, rule - 1, guess.select, guess.action);
}
