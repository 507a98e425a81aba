// What the learned program would select on the asset in hand, rule by rule, offered one after the other.
import { create } from "zustand";
import { api } from "../server/api";
import { problemOf } from "../server/http";
import type { Guess } from "../wire";
import { callOf } from "./actions";
import { draftStep } from "./draft";
import { useProject } from "./project";
import { getDetails } from "./scenes";
import { isDeclined, isSkipped, openRules, setStep } from "./steps";
import { useWorkspace } from "./workspace";

interface GuessesState {
  asset: string | null;
  guesses: readonly Guess[];
  loading: boolean;
  /** Why there are none. */
  error: string | null;
}

const noGuesses: GuessesState = { asset: null, guesses: [], loading: false, error: null };

export const useGuesses = create<GuessesState>()(() => noGuesses);

/** Keeps the guesses in step until the returned function is called, and offers the next one to an empty hand. */
export function followGuesses(): () => void {
  let known = "";
  let fresh = false;
  async function ask(key: string): Promise<void> {
    fresh = false;
    const answer = await fetchGuesses();
    if (key !== stateKey()) return;
    useGuesses.setState(answer);
    fresh = true;
    await offer();
  }
  function look(): void {
    const key = stateKey();
    if (key === known) return;
    known = key;
    void ask(key);
  }
  const stops = [
    useWorkspace.subscribe((now, before) => {
      look();
      if (fresh && before.draft && !now.draft) void offer();
    }),
    useProject.subscribe(look),
  ];
  look();
  return () => {
    stops.forEach((stop) => stop());
    useGuesses.setState(noGuesses);
  };
}

/** All that guesses depend on. */
function stateKey(): string {
  const { asset, stage } = useWorkspace.getState();
  const { revisions, program, outcome } = useProject.getState();
  return JSON.stringify([asset, stage, revisions[asset ?? ""], program.version, outcome?.number]);
}

async function fetchGuesses(): Promise<Partial<GuessesState>> {
  const { asset, stage } = useWorkspace.getState();
  const { program, outcome } = useProject.getState();
  if (asset === null || stage !== "demonstrate" || !(program.text || outcome?.program)) return noGuesses;
  if (useGuesses.getState().asset !== asset) useGuesses.setState({ ...noGuesses, asset, loading: true });
  try {
    return { ...noGuesses, asset, guesses: await api.guesses(asset) };
  } catch (error) {
    return { ...noGuesses, asset, error: problemOf(error).problem.message };
  }
}

/** Offers the guess for the first open rule as the action in hand, unless there is one or the guess was skipped. */
async function offer(): Promise<void> {
  const { asset, error } = useGuesses.getState();
  if (asset === null || error !== null) return;
  const { view } = await getDetails(asset);
  const place = openRules(view).find((k) => !isDeclined(asset, k));
  if (place === undefined) return;
  const guess = guessFor(place + 1);
  const { asset: now, draft, selection, tool, stage } = useWorkspace.getState();
  const isFree = now === asset && stage === "demonstrate" && draft === null && !selection.size && tool === "select";
  if (guess?.select.length && isFree && !isSkipped(asset, place)) await draftStep(place, guess.select);
}

/** The guess for a rule (from 1), where there is a sound one. */
export function guessFor(rule: number): Guess | undefined {
  return useGuesses.getState().guesses.find((guess) => guess.rule === rule && guess.error === null);
}

/** Takes the guess for a rule as the step. */
export async function acceptGuess(rule: number): Promise<void> {
  const { asset } = useGuesses.getState();
  const guess = guessFor(rule);
  if (asset !== null && guess && useWorkspace.getState().asset === asset)
    await setStep(asset, rule - 1, guess.select, callOf(guess.action));
}
