// The start page: what the server says of it, the new project that is being put together, and what went wrong.
import { create } from "zustand";
import { api } from "../server/api";
import { problemOf } from "../server/http";
import type { AssetsFound, NewProject, Problem, StartView } from "../wire";
import { chosenOptions } from "./decompose";
import { sendAfterEdits } from "./edits";
import { isSending, type PlacedFile, sendFiles } from "./upload";

export type Source = "folder" | "upload" | "family";

/** What a problem is about: the place where it is shown. */
export type Place = "open" | "assets" | "project" | "tour";

export interface StartState {
  /** What the start page shows; null while a project is open, or nothing is known. */
  view: StartView | null;
  source: Source;
  /** The folder of assets that was typed. */
  folder: string;
  /** What that folder, or the upload, holds; null until it was looked at. */
  found: AssetsFound | null;
  family: string;
  /** The folder of the new project. */
  project: string;
  decompose: boolean;
  busy: "look" | "open" | "make" | null;
  problem: { place: Place; problem: Problem } | null;
}

export const initialStart: StartState = {
  view: null,
  source: "folder",
  folder: "",
  found: null,
  family: "",
  project: "",
  decompose: true,
  busy: null,
  problem: null,
};

export const useStart = create<StartState>()(() => initialStart);

const set = useStart.setState;

/** Shows the start page; what a person has typed there stays. */
export function showStart(view: StartView): void {
  const { family, project, source } = useStart.getState();
  const offer = view.families.find((one) => one.name === family) ?? view.families[0];
  set({ view, family: offer?.name ?? "", project: source === "family" && !project ? (offer?.project ?? "") : project });
}

/** A project is open: the start page is as at first when it comes back. */
export const hideStart = (): void => set(initialStart);

export function chooseSource(source: Source): void {
  if (source === useStart.getState().source) return;
  set({ source, found: null, project: "", problem: null });
  if (source === "family") chooseFamily(useStart.getState().family);
}

export function chooseFamily(family: string): void {
  const offer = useStart.getState().view?.families.find((one) => one.name === family);
  set({ family, project: offer?.project ?? "", problem: null });
}

/** Another folder was typed: what was found in the one before holds no more. */
export const typeFolder = (folder: string): void => set({ folder, found: null, project: "", problem: null });

export function typeProject(project: string): void {
  set(({ problem }) => ({ project, problem: problem?.place === "project" ? null : problem }));
}

/** Looks what the typed folder, or another, holds. */
export async function lookAtFolder(folder = useStart.getState().folder): Promise<void> {
  set({ source: "folder", folder });
  await look(() => api.lookAtFolder(folder), () => useStart.getState().folder === folder);
}

/** Sends files for a new project, and looks what they hold. */
export async function uploadForProject(files: readonly PlacedFile[]): Promise<void> {
  if (useStart.getState().busy || isSending()) return; // what is on its way would lose the files that were sent
  chooseSource("upload");
  set({ found: null, project: "", problem: null });
  await api.clearFiles(); // what was dropped before
  await sendFiles(files, api.stageProjectFile, () => look(api.lookAtFiles));
}

/** Sets what was found; isWanted: whether it is still wanted then. */
async function look(ask: () => Promise<AssetsFound>, isWanted = () => true): Promise<void> {
  await attempt("look", "assets", async () => {
    set({ found: null });
    const found = await ask();
    if (isWanted()) set({ found, project: found.project, decompose: found.bare > 0 && found.seen === 0 });
  });
}

/** What the server is asked to make. */
export function newProject({ source, folder, family, project, decompose, found }: StartState): NewProject {
  const options = chosenOptions();
  const by = found !== null && found.divided > 0 ? options.by : "whole";
  const hulls = { decompose: decompose && found !== null && found.bare > 0 ? { ...options, by } : null };
  switch (source) {
    case "folder":
      return { kind: "folder", folder: found?.folder ?? folder, project, ...hulls };
    case "upload":
      return { kind: "upload", project, ...hulls };
    case "family":
      return { kind: "family", family, project };
  }
}

/** Makes the new project, which opens by itself. */
export const makeProject = (): Promise<void> => attempt("make", "project", () => api.makeProject(newProject(useStart.getState())));

/** Makes the project of the guided tour in a folder, and opens it. */
export const takeTour = (project: string): Promise<void> => attempt("make", "tour", () => api.makeProject({ kind: "tour", project }));

export const openProject = (folder: string): Promise<void> => attempt("open", "open", () => api.openProject(folder));

export const forgetProject = (folder: string): Promise<void> =>
  api.forgetProject(folder).then((view) => set({ view, problem: null }));

/** Leaves the open project for the start page, once all edits before are saved. */
export const leaveProject = (): Promise<unknown> => sendAfterEdits(api.leaveProject);

/** Does one thing at a time; what goes wrong is shown at its place. */
async function attempt(busy: NonNullable<StartState["busy"]>, place: Place, does: () => Promise<unknown>): Promise<void> {
  if (useStart.getState().busy) return;
  set({ busy, problem: null });
  try {
    await does();
  } catch (error) {
    set({ problem: { place, problem: problemOf(error).problem } });
  } finally {
    set({ busy: null });
  }
}
