// The start page: what is asked of the server, and what is shown of its answers.
import { beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { AssetsFound } from "../wire";
import { setOptions, useDecompose } from "./decompose";
import * as start from "./start";
import { useToasts } from "./toasts";

vi.mock("../server/api", () => ({
  api: { lookAtFolder: vi.fn(), clearFiles: vi.fn(), stageProjectFile: vi.fn(), lookAtFiles: vi.fn(), makeProject: vi.fn(), openProject: vi.fn() },
}));
const server = vi.mocked(api);

const view = { version: "1", recent: [], places: ["/home"], tour: "/p/tour", families: [{ name: "cups", about: "", project: "/p/cups" }, { name: "tables", about: "", project: "/p/tables" }] };
const found: AssetsFound = { folder: "/a", kinds: "3 URDF", assets: 3, read: 3, pieces: 2, seen: 0, bare: 1, divided: 0, parts: [], broken: 0, problem: null, left_out: false, project: "/p/a" };
const problem = new ServerProblem({ message: "there is no such folder", where: "/a", remedy: "Browse for it.", conflict: false }, 400);
const state = () => start.useStart.getState();

beforeEach(() => {
  vi.clearAllMocks();
  start.useStart.setState(start.initialStart, true);
  useDecompose.setState(useDecompose.getInitialState(), true);
  start.showStart(view);
  server.lookAtFolder.mockResolvedValue(found);
});

describe("a project of a folder", () => {
  it("is offered a place, and hulls where some are missing", async () => {
    start.typeFolder("/a");
    await start.lookAtFolder();
    expect([state().project, state().decompose, state().busy]).toEqual(["/p/a", true, null]);
    await start.makeProject();
    expect(server.makeProject).toHaveBeenCalledWith({ kind: "folder", folder: "/a", project: "/p/a", decompose: { method: "coacd", by: "whole", most: null, threshold: null } });
  });

  it("is not decomposed where nothing is to be, or nobody wants it", async () => {
    server.lookAtFolder.mockResolvedValue({ ...found, bare: 0, pieces: 0 });
    await start.lookAtFolder("/a");
    expect(start.newProject(state())).toMatchObject({ decompose: null });
    server.lookAtFolder.mockResolvedValue({ ...found, seen: 1 }); // by itself nothing collides that was only seen
    await start.lookAtFolder("/a");
    expect(start.newProject(state())).toMatchObject({ decompose: null });
    server.lookAtFolder.mockResolvedValue(found);
    await start.lookAtFolder("/a");
    setOptions({ method: "vhacd", most: 8 });
    expect(start.newProject(state())).toMatchObject({ decompose: { method: "vhacd", most: 8 } });
    start.useStart.setState({ decompose: false });
    expect(start.newProject(state())).toMatchObject({ decompose: null });
  });

  it("is decomposed part by part only where parts are known", async () => {
    setOptions({ by: "parts" });
    await start.lookAtFolder("/a");
    expect(start.newProject(state())).toMatchObject({ decompose: { method: "coacd", by: "whole" } });
    server.lookAtFolder.mockResolvedValue({ ...found, divided: 1, parts: ["wall", "handle"] });
    await start.lookAtFolder("/a");
    expect(start.newProject(state())).toMatchObject({ decompose: { by: "parts" } });
  });

  it("shows a problem at its place, until something else is typed", async () => {
    server.lookAtFolder.mockRejectedValue(problem);
    await start.lookAtFolder("/a");
    expect([state().found, state().problem]).toEqual([null, { place: "assets", problem: problem.problem }]);
    start.typeFolder("/b");
    expect(state().problem).toBe(null);
  });

  it("forgets what was found when another folder is typed meanwhile", async () => {
    server.lookAtFolder.mockImplementation(async () => {
      start.typeFolder("/b");
      return found;
    });
    await start.lookAtFolder("/a");
    expect(state().found).toBe(null);
  });
});

it("dropped files are sent in place of those before, and looked at", async () => {
  server.lookAtFiles.mockResolvedValue(found);
  await start.uploadForProject([{ path: "desks/a.obj", file: new Blob() }]);
  expect(server.clearFiles).toHaveBeenCalledOnce();
  expect(server.stageProjectFile.mock.calls.map(([path]) => path)).toEqual(["desks/a.obj"]);
  expect([state().source, state().project]).toEqual(["upload", "/p/a"]);
  expect(start.newProject(state())).toEqual({ kind: "upload", project: "/p/a", decompose: { method: "coacd", by: "whole", most: null, threshold: null } });
});

it("files that are dropped while others are sent take none of these away", async () => {
  server.lookAtFiles.mockResolvedValue(found);
  const desks = [{ path: "desks/a.obj", file: new Blob() }];
  server.stageProjectFile.mockImplementationOnce(async () => {
    await start.uploadForProject([{ path: "chairs/b.obj", file: new Blob() }]);
    return { names: [] };
  });
  await start.uploadForProject(desks);
  expect(server.clearFiles).toHaveBeenCalledOnce();
  expect([state().found, useToasts.getState().toasts.at(-1)?.text]).toEqual([found, "Other files are being added. Add these when they are done."]);
});

it("a bundled family is offered a place of its own", () => {
  start.chooseSource("family");
  expect([state().family, state().project]).toEqual(["cups", "/p/cups"]);
  start.chooseFamily("tables");
  expect(start.newProject(state())).toEqual({ kind: "family", family: "tables", project: "/p/tables" });
});

it("the tour is a project in the folder that is typed", async () => {
  await start.takeTour("/mine");
  expect(server.makeProject).toHaveBeenCalledWith({ kind: "tour", project: "/mine" });
});

it("one thing is done at a time", async () => {
  start.useStart.setState({ busy: "make" });
  await start.openProject("/p");
  expect(server.openProject).not.toHaveBeenCalled();
});
