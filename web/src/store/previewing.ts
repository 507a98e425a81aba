// Asks the server what the action in hand would do, whenever the action, the selection or the asset changes.
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { PreviewRequest } from "../wire";
import { useDesk } from "./desk";
import { chosen, useDrafting, writtenOut } from "./drafting";
import { missingArgument, placeOf } from "./drafts";
import { formOf, language } from "./language";
import { setPreview } from "./preview";
import { useProject } from "./project";
import { useScenes } from "./scenes";
import { complainedOf } from "./toasts";

const WAIT = 60;
/** How long the preview of an accepted step stays at most until the step itself is shown [ms]. */
const LANDING = 600;

/** Keeps the preview in step until the returned function is called; result: of the program's output. */
export function followPreview(result: boolean): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  let stop = new AbortController();
  let asked = "";

  async function look(): Promise<void> {
    const { landing } = useDrafting.getState();
    if (landing !== null && landing === useScenes.getState().scene && !useDesk.getState().draft) return soon(LANDING);
    const request = await wanted(result);
    const key = JSON.stringify([request, useScenes.getState().scene?.view.version]);
    if (key === asked) return;
    asked = key;
    stop.abort();
    stop = new AbortController();
    if (request) await shownFor(request, stop.signal);
    else leave();
  }
  function soon(wait = WAIT): void {
    clearTimeout(timer);
    timer = setTimeout(() => {
      if (wait === LANDING) useDrafting.setState({ landing: null });
      look().catch(complainedOf);
    }, wait);
  }
  const stops = [
    useDesk.subscribe((now, before) => {
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
    leave();
  };
}

/** What is to be asked; null while there is nothing to preview. */
async function wanted(result: boolean): Promise<PreviewRequest | null> {
  const { asset, draft } = useDesk.getState();
  const { scene } = useScenes.getState();
  const select = chosen();
  if (!draft || !scene || scene.asset !== asset || !select.length) return null;
  const form = formOf(draft.action, (await language()).actions);
  if (!form || missingArgument(draft, form)) return null;
  const own = scene.view.steps.length;
  const steps = Math.min(placeOf(draft, useProject.getState().project.rules.length, own), own);
  return { asset, select, action: await writtenOut(draft), ...(result ? { result } : { steps }) };
}

async function shownFor(request: PreviewRequest, signal: AbortSignal): Promise<void> {
  try {
    const packet = await api.preview(request, signal);
    if (signal.aborted) return;
    setPreview(packet);
    useDrafting.setState({ problem: null });
  } catch (error) {
    if (signal.aborted) return;
    setPreview(null);
    if (error instanceof ServerProblem) useDrafting.setState({ problem: error.problem });
    else throw error;
  }
}

function leave(): void {
  setPreview(null);
  useDrafting.setState({ problem: null });
}
