// Connects the stores to the server with the token of the address, knows why there is no connection, and opens what
// this tab had open before.
import { create } from "zustand";
import { api } from "../server/api";
import { getJson, setToken as keep, ServerProblem } from "../server/http";
import { listen } from "../server/socket";
import { receive, useProject } from "../store/project";
import { pendingEdits, useUnsaved } from "../store/edits";
import { followWorkspace } from "../store/scenes";
import { hideStart, showStart } from "../store/start";
import {
  type Draft,
  openAsset,
  openStage,
  type Showing,
  STAGE_OF,
  type StageName,
  STAGES,
  useWorkspace,
  type WorkspaceState,
} from "../store/workspace";
import type { Event } from "../wire";

/** stopped: it did not answer for some tries; refused: the server is another one than that whose token this page has;
 * elsewhere: it has another project open, or cannot open that of this page, whose edits wait. */
export type NoConnection = "lost" | "stopped" | "refused" | "elsewhere";

/** why: the reason where the server gave one. */
export const useConnection = create<{ state: "connecting" | "open" | NoConnection; why?: string }>()(() => ({ state: "connecting" }));

/** Tries without an answer after which the studio counts as stopped: some seconds. */
const TRIES = 4;
let tries = 0;

/** What starts the studio of this page again. */
export function startCommand(): string {
  const { ready, leave, project } = useProject.getState();
  if (!ready || leave) return "meshforge studio";
  return `meshforge studio ${/^[\w./-]+$/.test(project.folder) ? project.folder : `'${project.folder.replaceAll("'", "'\\''")}'`}`;
}

export function connect(): void {
  let followed = false;
  function heard(event: Event): void {
    if (isElsewhere(event)) return void goElsewhere(event);
    if (event.kind === "start" || event.kind === "hello") setConnected(true);
    if (event.kind === "start") return showStart(event.start);
    if (event.kind === "hello") hideStart();
    receive(event);
    if (followed || event.kind !== "hello") return;
    followed = true;
    followWorkspace();
    restorePlace();
    rememberPlace();
  }
  listen({ receive: heard, lost: () => setConnected(false) });
}

/** Whether the server has another project open than the one that this page shows, or none. */
function isElsewhere(event: Event): boolean {
  const { ready, project } = useProject.getState();
  if (!ready) return false;
  return event.kind === "start" || (event.kind === "hello" && event.project.folder !== project.folder);
}

/** A studio that was started anew opens the project of this page again, and the page goes on. Where another project was
 * opened, or this one was left, the page shows that, once its edits are saved. */
async function goElsewhere({ kind }: Event): Promise<void> {
  const { connected, project } = useProject.getState();
  if (connected) {
    await pendingEdits();
    return startAnew();
  }
  let why = "It has another project open: leave that one, and this page goes on by itself.";
  if (kind === "start")
    try {
      return void (await api.openProject(project.folder));
    } catch (error) {
      if (!(error instanceof ServerProblem)) throw error;
      if (error.status === 0 || error.status === 409) return; // it is gone again, or another page was faster
      why = [error.problem.where, error.problem.message].filter(Boolean).join(": ");
    }
  if (useUnsaved.getState().count) useConnection.setState({ state: "elsewhere", why });
  else startAnew();
}

/** Loads the page again, so that nothing of the project before is left. */
function startAnew(): void {
  sessionStorage.removeItem(PLACE_KEY);
  location.reload();
}

function setConnected(is: boolean): void {
  useProject.setState({ connected: is });
  tries = is ? 0 : tries + 1;
  if (is) useConnection.setState({ state: "open" });
  else void findReason().then((state) => !useProject.getState().connected && useConnection.setState({ state }));
}

async function findReason(): Promise<NoConnection> {
  try {
    await getJson("api/token"); // there is no such address, which only a page with the token of this server learns
    return "lost";
  } catch (error) {
    return error instanceof ServerProblem && (error.status === 401 || error.status === 403) ? "refused" : tries < TRIES ? "lost" : "stopped";
  }
}

/** Opens what this tab had open before it was loaded again, with the action in hand; in a new tab what was open in the one
 * before, or what is next. */
function restorePlace(): void {
  const { cards, order, project } = useProject.getState();
  const own = storedPlace(sessionStorage, PLACE_KEY);
  const before = own.stage === null ? storedPlace(localStorage, lastPlaceKey()) : own;
  openStage(before.stage ?? STAGE_OF[project.next.kind]);
  const known = before.asset !== null && before.asset in cards ? before.asset : null;
  const readable = order.find((asset) => cards[asset]?.error === null && cards[asset].hulls !== 0);
  openAsset(known ?? project.next.asset ?? readable ?? order[0] ?? null);
  if (known === null) leaveUnreadable();
  const { hand } = own;
  if (hand && known !== null) useWorkspace.setState({ ...hand, selection: new Set(hand.selection) });
}

/** Where the asset that was opened unasked cannot be read, or has no hulls, goes on to the first that has some. */
function leaveUnreadable(): void {
  const { asset: opened } = useWorkspace.getState();
  const stop = useProject.subscribe(({ cards, order }) => {
    const card = cards[opened ?? ""];
    const isUnread = card?.hulls === null && card.error === null;
    if (isUnread) return;
    const better = useWorkspace.getState().asset === opened && !card?.hulls ? order.find((asset) => cards[asset]?.hulls) : opened;
    if (better === undefined) return; // the others are still being read
    stop();
    if (better !== opened) openAsset(better);
  });
}

const PLACE_KEY = "meshforge.place";

/** Of each project the last place is kept, for tabs that are opened later. */
const lastPlaceKey = (): string => `${PLACE_KEY} ${useProject.getState().project.folder}`;

interface Place {
  readonly asset: string | null;
  readonly stage: StageName | null;
  /** The action in hand, its hulls, and in which state the asset is shown for it. */
  readonly hand: { draft: Draft; selection: readonly string[]; asked: Showing | null } | null;
}

const nowhere: Place = { asset: null, stage: null, hand: null };

/** Where one was, so that loading the page again loses no place and nothing in hand. */
function storedPlace(storage: Storage, key: string): Place {
  try {
    const { asset, stage, hand } = JSON.parse(storage.getItem(key) ?? "{}") as Record<string, unknown>;
    return {
      asset: typeof asset === "string" ? asset : null,
      stage: STAGES.find((known) => known === stage) ?? null,
      hand: isHand(hand) ? hand : null,
    };
  } catch {
    return nowhere;
  }
}

/** Whether what was kept is an action in hand, as this page knows it. */
function isHand(value: unknown): value is NonNullable<Place["hand"]> {
  if (typeof value !== "object" || value === null) return false;
  const { draft, selection } = value as { draft?: Partial<Draft> | null; selection?: unknown };
  const isDraft = typeof draft?.name === "string" && typeof draft.arguments === "object" && draft.editing !== undefined;
  return isDraft && Array.isArray(selection) && selection.every((name) => typeof name === "string");
}

function rememberPlace(): void {
  keepPlace(useWorkspace.getState());
  useWorkspace.subscribe((now, before) => {
    const moved = now.asset !== before.asset || now.stage !== before.stage;
    const isOtherHand = now.draft !== before.draft || (now.draft !== null && now.selection !== before.selection);
    if (moved || isOtherHand) keepPlace(now);
  });
}

function keepPlace({ asset, stage, draft, selection, asked }: WorkspaceState): void {
  sessionStorage.setItem(PLACE_KEY, JSON.stringify({ asset, stage, hand: draft && { draft, selection: [...selection], asked } }));
  localStorage.setItem(lastPlaceKey(), JSON.stringify({ asset, stage }));
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
