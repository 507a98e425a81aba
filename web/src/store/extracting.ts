// What an extractor that is being typed selects: here, and on the whole family.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Mark, Selected } from "../wire";
import { type DeskState, select, setHighlight, useDesk } from "./desk";
import { type Spread, spreadOf } from "./lessons";
import { useScenes } from "./scenes";
import { complainedOf } from "./toasts";

interface ExtractingState {
  text: string;
  /** What a text selects; it stays until the next answer is there. */
  found: Selected | null;
  /** The text and the state of the asset that `found` is of. */
  of: string;
  /** How many hulls it selects on all assets, and on how many. */
  family: Spread | null;
}

const nothing: ExtractingState = { text: "", found: null, of: "", family: null };

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

/** Selects what the text selects, once that is known; whether the text is an extractor. */
export async function takeFound(): Promise<boolean> {
  const { text } = useExtracting.getState();
  clearTimeout(timer);
  try {
    if (useExtracting.getState().of !== asked(text)) await look(text.trim(), stop.signal);
  } catch (error) {
    complainedOf(error);
  }
  const { found, of } = useExtracting.getState();
  if (!found || found.mark || of !== asked(text)) return false;
  const there = new Set(useScenes.getState().scene?.hulls.map((hull) => hull.name));
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
  if (asset === null || !extractor) return;
  const of = asked(extractor);
  try {
    const found = await api.select({ asset, steps: stepsOf(showing), extractor }, signal);
    useExtracting.setState({ found, of, family: null });
    if (found.mark) return setHighlight(null);
    void spread(extractor, stepsOf(showing) + 1, signal).catch(complainedOf);
  } catch (error) {
    if (signal.aborted) return;
    if (!(error instanceof ServerProblem)) throw error;
    useExtracting.setState({ found: { select: [], sentence: "", mark: markOf(error) }, of, family: null });
  }
}

/** Shows on all thumbnails what an extractor selects, as a rule of that number meets them. */
async function spread(extractor: string, rule: number, signal: AbortSignal): Promise<void> {
  const { assets } = await api.generalise(extractor, rule, signal);
  if (signal.aborted) return;
  useExtracting.setState({ family: spreadOf(Object.values(assets).map((hulls) => hulls.length)) });
  setHighlight({ what: extractor, assets });
}

/** What an answer belongs to. */
function asked(text: string): string {
  const { asset, showing } = useDesk.getState();
  return JSON.stringify([text.trim(), asset, showing]);
}

const stepsOf = (showing: DeskState["showing"]): number => (showing.kind === "steps" ? showing.steps : 0);

const markOf = (error: ServerProblem): Mark => ({ line: 1, column: 1, message: error.problem.message });
