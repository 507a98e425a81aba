// What an extractor that is being typed selects: here, and on the whole family.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Mark, Selected } from "../wire";
import { type DeskState, select, setHighlight, useDesk } from "./desk";
import { useScenes } from "./scenes";
import { complainedOf } from "./toasts";

interface ExtractingState {
  text: string;
  /** What the text selects on the asset in hand; null until it is known. */
  found: Selected | null;
  /** How many hulls it selects on all assets, and on how many. */
  family: { hulls: number; assets: number } | null;
}

const nothing: ExtractingState = { text: "", found: null, family: null };

export const useExtracting = create<ExtractingState>()(() => nothing);

const WAIT = 120;
let timer: ReturnType<typeof setTimeout> | undefined;
let stop = new AbortController();

/** Looks for what a text selects, a moment after the last key. */
export function typed(text: string): void {
  clearTimeout(timer);
  stop.abort();
  stop = new AbortController();
  const { signal } = stop;
  if (!text.trim()) {
    useExtracting.setState({ ...nothing, text });
    return setHighlight(null);
  }
  useExtracting.setState({ text });
  timer = setTimeout(() => void look(text.trim(), signal).catch(complainedOf), WAIT);
}

/** Selects what was found; whether there was anything. */
export function takeFound(): boolean {
  const { found } = useExtracting.getState();
  const { scene } = useScenes.getState();
  if (!found || found.mark) return false;
  const there = new Set(scene?.hulls.map((hull) => hull.name));
  select(found.select.filter((name) => there.has(name)));
  return true;
}

/** The thumbnails no longer show what the text selects. */
export function left(): void {
  clearTimeout(timer);
  stop.abort();
  const { highlight } = useDesk.getState();
  if (highlight?.what === useExtracting.getState().text.trim()) setHighlight(null);
}

async function look(extractor: string, signal: AbortSignal): Promise<void> {
  const { asset, showing } = useDesk.getState();
  if (asset === null) return;
  try {
    const found = await api.select({ asset, steps: stepsOf(showing), extractor }, signal);
    useExtracting.setState({ found, family: null });
    if (found.mark) return setHighlight(null);
    const { assets } = await api.generalise(extractor, stepsOf(showing) + 1, signal);
    const counts = Object.values(assets).map((hulls) => hulls.length);
    const family = { hulls: counts.reduce((sum, n) => sum + n, 0), assets: counts.filter((n) => n > 0).length };
    useExtracting.setState({ family });
    setHighlight({ what: extractor, assets });
  } catch (error) {
    if (signal.aborted) return;
    if (!(error instanceof ServerProblem)) throw error;
    useExtracting.setState({ found: { select: [], sentence: "", mark: markOf(error) }, family: null });
  }
}

const stepsOf = (showing: DeskState["showing"]): number => (showing.kind === "steps" ? showing.steps : 0);

const markOf = (error: ServerProblem): Mark => ({ line: 1, column: 1, message: error.problem.message });
