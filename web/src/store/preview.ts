// What the action in hand would make of the asset: asked of the server whenever action, selection or asset change.
import { create } from "zustand";
import { api } from "../server/api";
import { problemOf } from "../server/http";
import type { EditedPacket } from "../server/packet";
import type { EditHeader, PreviewRequest } from "../wire";
import { callOf, formOf, missingArgument } from "./actions";
import { selectedHulls, useDraftStatus } from "./draft";
import { useProject } from "./project";
import { useScenes } from "./scenes";
import { placeOf } from "./steps";
import { countText } from "./words";
import { useWorkspace } from "./workspace";

export const usePreview = create<{ preview: EditedPacket | null }>()(() => ({ preview: null }));

function setPreview(preview: EditedPacket | null): void {
  if (usePreview.getState().preview !== preview) usePreview.setState({ preview });
}

const WAIT = 60;
/** How long the preview of an accepted step stays at most until the step itself is shown [ms]. */
const LANDING = 600;

/** Keeps the preview in step until the returned function is called; result: of the program's output. */
export function followPreview(result: boolean): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let stop = new AbortController();
  let asked = "";

  async function look(): Promise<void> {
    const { landing } = useDraftStatus.getState();
    if (landing !== null && landing === useScenes.getState().scene && !useWorkspace.getState().draft) return soon(LANDING);
    const request = nextRequest(result);
    const key = JSON.stringify([request, useScenes.getState().scene?.view.version]);
    if (key === asked) return;
    asked = key;
    stop.abort();
    stop = new AbortController();
    if (request) await requestPreview(request, stop.signal);
    else clearPreview();
  }
  function soon(wait = WAIT): void {
    clearTimeout(timer);
    timer = setTimeout(() => {
      if (wait === LANDING) useDraftStatus.setState({ landing: null });
      void look();
    }, wait);
  }
  const stops = [
    useWorkspace.subscribe((now, before) => {
      if (now.draft !== before.draft || now.selection !== before.selection || now.asset !== before.asset) soon();
    }),
    useScenes.subscribe((now, before) => {
      if (now.scene !== before.scene) soon();
    }),
  ];
  soon();
  return () => {
    clearTimeout(timer);
    stop.abort();
    stops.forEach((end) => end());
    clearPreview();
  };
}

/** What is to be asked; null while there is nothing to preview. */
function nextRequest(result: boolean): PreviewRequest | null {
  const { asset, draft } = useWorkspace.getState();
  const { scene } = useScenes.getState();
  const select = selectedHulls();
  if (!draft || !scene || scene.asset !== asset || !select.length) return null;
  const form = formOf(draft.name, useProject.getState().language.actions);
  if (!form || missingArgument(draft, form)) return null;
  const own = scene.view.steps.length;
  const steps = Math.min(placeOf(draft, useProject.getState().project.rules.length, own), own);
  return { asset, select, action: callOf(draft), ...(result ? { result } : { steps }) };
}

async function requestPreview(request: PreviewRequest, signal: AbortSignal): Promise<void> {
  try {
    const packet = await api.preview(request, signal);
    if (signal.aborted) return;
    setPreview(packet);
    useDraftStatus.setState({ problem: null });
  } catch (error) {
    if (signal.aborted) return;
    setPreview(null);
    useDraftStatus.setState({ problem: problemOf(error).problem });
  }
}

function clearPreview(): void {
  setPreview(null);
  useDraftStatus.setState({ problem: null });
}

/** What an action in hand would do: `12 hulls → 1`, `4 hulls go`, `1 hull is added`. */
export function previewText(selected: number, { made, removed }: Pick<EditHeader, "made" | "removed">): string {
  if (!made.length && !removed.length) return "Nothing changes";
  if (!made.length) return `${countText(removed.length, "hull")} ${removed.length === 1 ? "goes" : "go"}`;
  if (!removed.length) return `${countText(made.length, "hull")} ${made.length === 1 ? "is" : "are"} added`;
  return `${countText(Math.max(removed.length, selected), "hull")} → ${made.length}`;
}
