// The assets' details and shapes, fetched once and kept until the server says that they changed, and the scene to show:
// it goes with asset, stage and what the server says.
import { create } from "zustand";
import { api } from "../server/api";
import { problemOf, ServerProblem } from "../server/http";
import type { EditedPacket, ShapesPacket } from "../server/packet";
import type { AssetView, Problem } from "../wire";
import { notePositions } from "./hullPlaces";
import { keepLatest } from "./once";
import { useProject } from "./project";
import type { Scene } from "./scene";
import { sheetOf } from "./sheetScene";
import { openAsset, show, showSheet, type Showing, useWorkspace, type WorkspaceState } from "./workspace";

export type { Scene, SceneHull } from "./scene";

interface Details {
  view: AssetView;
  packet: ShapesPacket;
  /** The revisions that these are of. */
  revision: number;
  shapeRevision: number;
}

interface ScenesState {
  /** The scene to show; the one before stays until the next is there, so that nothing flickers. */
  scene: Scene | null;
  loading: boolean;
  problem: Problem | null;
}

export const useScenes = create<ScenesState>()(() => ({ scene: null, loading: false, problem: null }));

const MOST = 60;
const kept = new Map<string, Details>();
/** What is on its way, or could not be had. */
const asked = new Map<string, { revision: number; shapeRevision: number; result: Promise<Details> }>();
const edited = new Map<string, EditedPacket>();
let wanted = 0;

/** Shows an asset in a state; fetches what is missing. The last call wins. */
export async function showScene(asset: string | null, showing: Showing): Promise<void> {
  const mine = ++wanted;
  if (asset === null) return useScenes.setState({ scene: null, loading: false, problem: null });
  useScenes.setState({ loading: true });
  try {
    const { stage, sheet } = useWorkspace.getState();
    const isSheet = sheet.length > 1 && stage === "label" && showing.kind === "source";
    const scene = await (isSheet ? sheetSceneOf(sheet, asset) : sceneOf(asset, showing));
    if (mine === wanted) useScenes.setState({ scene, loading: false, problem: null });
  } catch (error) {
    const { problem } = problemOf(error);
    if (mine === wanted) useScenes.setState({ scene: null, loading: false, problem });
  }
}

export async function sceneOf(asset: string, showing: Showing): Promise<Scene> {
  const [own, edit] = await Promise.all([getDetails(asset), editOf(asset, showing)]);
  return sceneFrom(asset, showing, own.view, own.packet, edit);
}

/** Several assets side by side; those that cannot be read are left out. */
async function sheetSceneOf(assets: readonly string[], open: string): Promise<Scene> {
  const alone = sceneOf(open, { kind: "source" });
  const scenes = await Promise.allSettled(assets.map((asset) => (asset === open ? alone : sceneOf(asset, { kind: "source" }))));
  return sheetOf(scenes.flatMap((one) => (one.status === "fulfilled" ? [one.value] : [])), open, useWorkspace.getState().view.oneSize) ?? alone;
}

/** Puts a scene together; hulls of an edit that the asset has, too, take their shape from there. */
function sceneFrom(
  asset: string,
  showing: Showing,
  view: AssetView,
  packet: ShapesPacket,
  edit: EditedPacket | null,
): Scene {
  const count = view.hulls.length;
  const own = new Map(view.hulls.map((hull, k) => [hull.name, packet.shapes[k]]));
  const made = new Map((edit?.rows ?? []).map((row, k) => [row.name, edit?.shapes[k]]));
  const hulls = (edit?.header.hulls ?? view.hulls).flatMap((hull) => {
    const shape = made.get(hull.name) ?? own.get(hull.name);
    return shape ? [{ ...hull, shape, made: made.has(hull.name) }] : [];
  });
  const opaque = view.non_convex
    .filter((piece) => piece.surface)
    .flatMap((piece, k) => {
      const shape = packet.shapes[count + k];
      return shape ? [{ ...piece, shape }] : [];
    });
  const contacts = edit ? edit.header.contacts : view.contacts;
  return { asset, showing, view, hulls, opaque, contacts, edit: edit?.header ?? null };
}

/** Fetches an asset ahead of time; a failure is reported only once it is opened. */
export function prefetch(asset: string): void {
  void getDetails(asset).catch(() => undefined);
}

/** The asset's own details and shapes, as they are now: fetched once for all who ask, also where it cannot be read. */
export async function getDetails(asset: string): Promise<Details> {
  const { revisions, shapeRevisions } = useProject.getState();
  const revision = revisions[asset] ?? 0;
  const shapeRevision = shapeRevisions[asset] ?? 0;
  const isOf = (one?: { revision: number; shapeRevision: number }) =>
    one?.revision === revision && one.shapeRevision === shapeRevision;
  const known = kept.get(asset);
  if (known && isOf(known)) return known;
  const before = asked.get(asset);
  if (before && isOf(before)) return before.result;
  const mine = { revision, shapeRevision, result: fetchDetails(asset, revision, shapeRevision) };
  asked.set(asset, mine);
  const forget = () => {
    if (asked.get(asset) === mine) asked.delete(asset);
  };
  // what the server has answered stays so until the asset changes; one that does not answer is asked again
  const refused = (error: unknown) => error instanceof ServerProblem && error.status !== 0;
  mine.result.then(forget, (error) => (refused(error) ? undefined : forget()));
  return mine.result;
}

async function fetchDetails(asset: string, revision: number, shapeRevision: number): Promise<Details> {
  const known = kept.get(asset);
  const same = known?.shapeRevision === shapeRevision;
  const [view, packet] = await Promise.all([api.asset(asset), same ? known.packet : api.shapes(asset)]);
  notePositions(asset, view.hulls.map(({ name }, position) => [name, position]));
  const fresh = { view, packet, revision, shapeRevision };
  keepLatest(kept, asset, fresh, MOST);
  return fresh;
}

async function editOf(asset: string, showing: Showing): Promise<EditedPacket | null> {
  if (showing.kind === "source" || (showing.kind === "steps" && showing.steps === 0)) return null;
  const state = useProject.getState();
  const revision = state.revisions[asset] ?? 0;
  const card = state.cards[asset];
  const of = showing.kind === "steps" ? `steps ${showing.steps}` : showing.kind === "hulls" ? showing.job : showing.of;
  const version = of === "program" ? state.program.version : of === "output" ? card?.edited_picture : "";
  const key = [asset, revision, of, version].join("\n");
  const known = edited.get(key);
  if (known) return known;
  const packet = await fetchEdit(asset, showing);
  keepLatest(edited, key, packet, MOST);
  return packet;
}

function fetchEdit(asset: string, showing: Exclude<Showing, { kind: "source" }>): Promise<EditedPacket> {
  if (showing.kind === "hulls") return api.triedHulls(asset);
  return showing.kind === "steps" ? api.stage(asset, showing.steps) : api.result(asset, showing.of);
}

/** Details of the asset in hand; null while they are on their way. */
export function useAssetView(): AssetView | null {
  const asset = useWorkspace((workspace) => workspace.asset);
  return useScenes(({ scene }) => (scene && scene.asset === asset ? scene.view : null));
}

/** Follows until the returned function is called. */
export function followWorkspace(): () => void {
  const stops = [
    useWorkspace.subscribe((now, before) => {
      if (now.asset !== before.asset || now.stage !== before.stage || now.sheet !== before.sheet || now.view.oneSize !== before.view.oneSize) void showUsual(now);
      else if (now.showing !== before.showing) void showScene(now.asset, now.showing);
    }),
    useProject.subscribe((now, before) => {
      const { asset, showing, sheet } = useWorkspace.getState();
      if (asset !== null && !(asset in now.cards)) return openAsset(now.order[0] ?? null);
      if (asset === null) return now.order.length ? openAsset(now.project.next.asset ?? now.order[0] ?? null) : undefined;
      if (sheet.some((one) => !(one in now.cards))) return showSheet(sheet.filter((one) => one in now.cards));
      const seen = sheet.length ? sheet : [asset];
      const other = (key: "revisions" | "shapeRevisions") => seen.some((one) => now[key][one] !== before[key][one]);
      const program = showing.kind === "result" && now.program.version !== before.program.version;
      if (other("revisions") || other("shapeRevisions")) void showUsual(useWorkspace.getState());
      else if (program) void showScene(asset, showing);
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Shows an asset in the state that its stage is about, and fetches those beside it. */
async function showUsual({ asset, stage }: WorkspaceState): Promise<void> {
  if (asset === null) return void showScene(null, { kind: "source" });
  const usually = await usualState(asset, stage).catch((): Showing => ({ kind: "source" }));
  const now = useWorkspace.getState();
  if (now.asset !== asset || now.stage !== stage) return;
  const showing = now.asked ?? usually;
  if (isSame(now.showing, showing)) void showScene(asset, showing);
  else show(showing);
  const { order } = useProject.getState();
  const at = order.indexOf(asset);
  for (const next of [order[at + 1], order[at - 1]]) if (next !== undefined) prefetch(next);
}

/** What a stage shows of an asset: its hulls, what its steps made of them so far, or the edited asset. */
async function usualState(asset: string, stage: WorkspaceState["stage"]): Promise<Showing> {
  if (stage === "label") return { kind: "source" };
  if (stage === "demonstrate") {
    const { view } = await getDetails(asset);
    const broken = view.steps.findIndex((step) => step.error !== null);
    return { kind: "steps", steps: broken < 0 ? view.steps.length : broken };
  }
  const { cards, program, reach } = useProject.getState();
  const { output, stale } = cards[asset] ?? { output: "none", stale: [] };
  if (stage === "review" && (output === "edited" || output === "unchanged")) return { kind: "result", of: "output" };
  const fails = reach[asset] ? reach[asset].error !== null : output === "failed" && !stale.length;
  return program.text && !fails ? { kind: "result", of: "program" } : { kind: "source" };
}

const isSame = (a: Showing, b: Showing): boolean => JSON.stringify(a) === JSON.stringify(b);

const LATEST = 3000; // [ms] where nothing is shown at all

let firstScene: Promise<void> | undefined;

/** When the page has shown its first asset, so that what is wanted less can wait for it. */
export function waitForFirstScene(): Promise<void> {
  return (firstScene ??= new Promise((done) => {
    const over = (): void => {
      stop();
      clearTimeout(timer);
      // it is drawn in the next frame
      requestAnimationFrame(() => setTimeout(done));
    };
    const timer = setTimeout(over, LATEST);
    const stop = useScenes.subscribe(({ scene, problem }) => (scene ?? problem) && over());
    if (useScenes.getState().scene) over();
  }));
}
