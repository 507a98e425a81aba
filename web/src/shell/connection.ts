// Connects the stores to the server with the token of the address, knows why there is no connection, and opens what
// this tab had open before.
import { create } from "zustand";
import { getJson, setToken as keep, ServerProblem } from "../server/http";
import { listen } from "../server/socket";
import { receive, useProject } from "../store/project";
import { followWorkspace } from "../store/scenes";
import { hideStart, showStart } from "../store/start";
import { openAsset, openStage, type StageName, STAGES, useWorkspace } from "../store/workspace";
import type { Event } from "../wire";

/** refused: the server is another one than that whose token this page has. */
export const useConnection = create<{ state: "connecting" | "open" | "lost" | "refused" }>()(() => ({
  state: "connecting",
}));

export function connect(): void {
  let followed = false;
  function heard(event: Event): void {
    if (isElsewhere(event)) return startAnew();
    if (event.kind === "start") return showStart(event.start);
    if (event.kind === "hello") hideStart();
    receive(event);
    if (followed || event.kind !== "hello") return;
    followed = true;
    followWorkspace();
    restorePlace();
    rememberPlace();
  }
  listen({ receive: heard, connected: setConnected });
}

/** Whether the server has another project open than the one that this page shows, or none. */
function isElsewhere(event: Event): boolean {
  const { ready, project } = useProject.getState();
  if (!ready) return false;
  return event.kind === "start" || (event.kind === "hello" && event.project.folder !== project.folder);
}

/** Loads the page again, so that nothing of the project before is left. */
function startAnew(): void {
  sessionStorage.removeItem(PLACE_KEY);
  location.reload();
}

function setConnected(is: boolean): void {
  useProject.setState({ connected: is });
  if (is) useConnection.setState({ state: "open" });
  else void findReason().then((state) => !useProject.getState().connected && useConnection.setState({ state }));
}

async function findReason(): Promise<"lost" | "refused"> {
  try {
    await getJson("api/language");
    return "lost";
  } catch (error) {
    return error instanceof ServerProblem && (error.status === 401 || error.status === 403) ? "refused" : "lost";
  }
}

/** Opens what this tab had open before it was loaded again, or what is next. */
function restorePlace(): void {
  const { cards, order, project } = useProject.getState();
  const before = storedPlace();
  openStage(before.stage ?? project.next.stage);
  const known = before.asset !== null && before.asset in cards ? before.asset : null;
  const readable = order.find((asset) => cards[asset]?.error === null && cards[asset].hulls !== 0);
  openAsset(known ?? project.next.asset ?? readable ?? order[0] ?? null);
}

const PLACE_KEY = "meshforge.place";

/** Where one was in this tab: asset and stage, so that loading the page again loses no place. */
function storedPlace(): { asset: string | null; stage: StageName | null } {
  try {
    const { asset, stage } = JSON.parse(sessionStorage.getItem(PLACE_KEY) ?? "{}") as Record<string, unknown>;
    return {
      asset: typeof asset === "string" ? asset : null,
      stage: STAGES.find((known) => known === stage) ?? null,
    };
  } catch {
    return { asset: null, stage: null };
  }
}

function rememberPlace(): void {
  useWorkspace.subscribe(({ asset, stage }, before) => {
    if (asset === before.asset && stage === before.stage) return;
    sessionStorage.setItem(PLACE_KEY, JSON.stringify({ asset, stage }));
  });
}

const TOKEN_KEY = "meshforge.token";

/** Takes the token of the address, or else the one that this tab had before. */
export function takeToken(): void {
  const here = new URL(location.href);
  const given = here.searchParams.get("token");
  if (given !== null) {
    sessionStorage.setItem(TOKEN_KEY, given);
    here.searchParams.delete("token");
    history.replaceState(null, "", here);
  }
  keep(given ?? sessionStorage.getItem(TOKEN_KEY) ?? "");
}
