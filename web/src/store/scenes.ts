// The assets' details and shapes, fetched once and kept until the server says that they changed.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { EditedPacket, Shape, ShapesPacket } from "../server/packet";
import type { AssetView, EditedHeader, HullView, OpaqueView, Problem } from "../wire";
import type { Showing } from "./desk";
import { useProject } from "./project";

export interface SceneHull extends HullView {
  readonly shape: Shape;
  /** Whether the asset as it comes does not have it. */
  readonly made: boolean;
}

/** What the viewport shows of an asset in one state. */
export interface Scene {
  readonly asset: string;
  readonly showing: Showing;
  readonly view: AssetView;
  readonly hulls: readonly SceneHull[];
  readonly opaque: readonly (OpaqueView & { shape: Shape })[];
  readonly contacts: readonly (readonly [string, string])[];
  /** Header of the edit that led here; null for the asset as it comes. */
  readonly edit: EditedHeader | null;
}

interface Kept {
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
const kept = new Map<string, Kept>();
/** What is on its way, or could not be had. */
const asked = new Map<string, { revision: number; shapeRevision: number; result: Promise<Kept> }>();
const edited = new Map<string, EditedPacket>();
let wanted = 0;

/** Shows an asset in a state; fetches what is missing. The last call wins. */
export async function showScene(asset: string | null, showing: Showing): Promise<void> {
  const mine = ++wanted;
  if (asset === null) return useScenes.setState({ scene: null, loading: false, problem: null });
  useScenes.setState({ loading: true });
  try {
    const scene = await sceneOf(asset, showing);
    if (mine === wanted) useScenes.setState({ scene, loading: false, problem: null });
  } catch (error) {
    if (!(error instanceof ServerProblem)) throw error;
    if (mine === wanted) useScenes.setState({ scene: null, loading: false, problem: error.problem });
  }
}

export async function sceneOf(asset: string, showing: Showing): Promise<Scene> {
  const [own, edit] = await Promise.all([details(asset), editOf(asset, showing)]);
  return sceneFrom(asset, showing, own.view, own.packet, edit);
}

/** Puts a scene together; hulls of an edit that the asset has, too, take their shape from there. */
export function sceneFrom(
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
  const opaque = view.opaque
    .filter((piece) => piece.surface)
    .flatMap((piece, k) => {
      const shape = packet.shapes[count + k];
      return shape ? [{ ...piece, shape }] : [];
    });
  const contacts = edit ? edit.header.contacts : view.contacts;
  return { asset, showing, view, hulls, opaque, contacts, edit: edit?.header ?? null };
}

/** Fetches an asset ahead of time; failing is told only once it is opened. */
export function prefetch(asset: string): void {
  void details(asset).catch(() => undefined);
}

/** The asset's own details and shapes, as they are now: fetched once for all who ask, also where it cannot be read. */
export async function details(asset: string): Promise<Kept> {
  const { revisions, shapeRevisions } = useProject.getState();
  const revision = revisions[asset] ?? 0;
  const shapeRevision = shapeRevisions[asset] ?? 0;
  const isOf = (one?: { revision: number; shapeRevision: number }) =>
    one?.revision === revision && one.shapeRevision === shapeRevision;
  const known = kept.get(asset);
  if (known && isOf(known)) return known;
  const before = asked.get(asset);
  if (before && isOf(before)) return before.result;
  const mine = { revision, shapeRevision, result: fetched(asset, revision, shapeRevision) };
  asked.set(asset, mine);
  const forget = () => {
    if (asked.get(asset) === mine) asked.delete(asset);
  };
  // what the server has answered stays so until the asset changes; one that does not answer is asked again
  const refused = (error: unknown) => error instanceof ServerProblem && error.status !== 0;
  mine.result.then(forget, (error) => (refused(error) ? undefined : forget()));
  return mine.result;
}

async function fetched(asset: string, revision: number, shapeRevision: number): Promise<Kept> {
  const known = kept.get(asset);
  const same = known?.shapeRevision === shapeRevision;
  const [view, packet] = await Promise.all([api.asset(asset), same ? known.packet : api.shapes(asset)]);
  const fresh = { view, packet, revision, shapeRevision };
  kept.delete(asset);
  kept.set(asset, fresh);
  if (kept.size > MOST) kept.delete(kept.keys().next().value ?? "");
  return fresh;
}

async function editOf(asset: string, showing: Showing): Promise<EditedPacket | null> {
  if (showing.kind === "source" || (showing.kind === "steps" && showing.steps === 0)) return null;
  const state = useProject.getState();
  const revision = state.revisions[asset] ?? 0;
  const card = state.cards[asset];
  const of = showing.kind === "steps" ? `steps ${showing.steps}` : showing.of;
  const version = of === "program" ? state.program.version : of === "output" ? card?.edited_picture : "";
  const key = [asset, revision, of, version].join("\n");
  const known = edited.get(key);
  if (known) return known;
  const packet =
    showing.kind === "steps" ? await api.stage(asset, showing.steps) : await api.result(asset, showing.of);
  edited.set(key, packet);
  if (edited.size > MOST) edited.delete(edited.keys().next().value ?? "");
  return packet;
}
