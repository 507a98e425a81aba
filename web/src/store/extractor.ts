// What an extractor that is being typed selects: here, and on the whole family.
import { create } from "zustand";
import { api } from "../server/api";
import { problemOf } from "../server/http";
import type { SelectionView } from "../wire";
import { type Coverage, coverageOf } from "./outcome";
import { useScenes } from "./scenes";
import { type Highlight, select, setHighlight, useWorkspace, type WorkspaceState } from "./workspace";

interface ExtractorState {
  text: string;
  /** What a text selects; it stays until the next answer is there. */
  found: SelectionView | null;
  /** The text and the state of the asset that `found` is of. */
  of: string;
  /** How many hulls it selects on all assets, and on how many. */
  family: Coverage | null;
}

const emptyExtractor: ExtractorState = { text: "", found: null, of: "", family: null };

export const useExtractor = create<ExtractorState>()(() => emptyExtractor);

const WAIT = 120;
let timer: ReturnType<typeof setTimeout> | undefined;
let stop = new AbortController();
/** What is pointed out for the text, which may be another by now. */
let pointed: Highlight | null = null;

/** Points out what a text selects in place of what was pointed out for the one before; what others point out stays. */
function pointOut(highlight: Highlight | null): void {
  const isOurs = pointed !== null && useWorkspace.getState().highlight === pointed;
  if (highlight || isOurs) setHighlight(highlight);
  pointed = highlight;
}

/** Looks for what a text selects, a moment after the last key. */
export function typeExtractor(text: string): void {
  clearTimeout(timer);
  stop.abort();
  stop = new AbortController();
  const { signal } = stop;
  if (!text.trim()) {
    useExtractor.setState({ ...emptyExtractor, text });
    return pointOut(null);
  }
  useExtractor.setState({ text });
  timer = setTimeout(() => void search(text.trim(), signal), WAIT);
}

/** Selects what the text selects, once that is known; whether the text is an extractor. */
export async function selectFound(): Promise<boolean> {
  const { text } = useExtractor.getState();
  clearTimeout(timer);
  if (useExtractor.getState().of !== requestKey(text)) await search(text.trim(), stop.signal);
  const { found, of } = useExtractor.getState();
  if (!found || found.mark || of !== requestKey(text)) return false;
  const there = new Set(useScenes.getState().scene?.hulls.map((hull) => hull.name));
  select(found.select.filter((name) => there.has(name)));
  return true;
}

/** The thumbnails no longer show what the text selects. */
export function leaveExtractor(): void {
  clearTimeout(timer);
  stop.abort();
  pointOut(null);
}

async function search(extractor: string, signal: AbortSignal): Promise<void> {
  const { asset, showing } = useWorkspace.getState();
  if (asset === null || !extractor) return;
  const of = requestKey(extractor);
  try {
    const found = await api.select({ asset, steps: stepsOf(showing), extractor }, signal);
    useExtractor.setState({ found, of, family: null });
    if (found.mark) return pointOut(null);
    void searchFamily(extractor, stepsOf(showing) + 1, signal);
  } catch (error) {
    if (signal.aborted) return;
    const mark = { line: 1, column: 1, message: problemOf(error).problem.message };
    useExtractor.setState({ found: { select: [], sentence: "", mark }, of, family: null });
    pointOut(null);
  }
}

/** Shows on all thumbnails what an extractor selects, as a rule of that number meets them. */
async function searchFamily(extractor: string, rule: number, signal: AbortSignal): Promise<void> {
  const { assets } = await api.generalise(extractor, rule, signal);
  if (signal.aborted) return;
  useExtractor.setState({ family: coverageOf(Object.values(assets).map((hulls) => hulls.length)) });
  pointOut({ what: extractor, assets });
}

/** What an answer belongs to. */
function requestKey(text: string): string {
  const { asset, showing } = useWorkspace.getState();
  return JSON.stringify([text.trim(), asset, showing]);
}

const stepsOf = (showing: WorkspaceState["showing"]): number => (showing.kind === "steps" ? showing.steps : 0);
