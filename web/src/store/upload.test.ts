// Adding assets: what is sent, and what is said.
import { beforeEach, expect, test, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import { useToasts } from "./toasts";
import { addAssets, stopUpload, useUpload } from "./upload";

vi.mock("../server/api", () => ({ api: { stageAssetFile: vi.fn(), takeAssets: vi.fn() } }));

const stage = vi.mocked(api.stageAssetFile);
const take = vi.mocked(api.takeAssets);
const file = (path: string) => ({ path, file: new Blob([path]) });
const problem = (status: number) =>
  new ServerProblem({ message: "too large", where: "big.obj", remedy: "Make it smaller.", conflict: false }, status);
const said = () => useToasts.getState().toasts.map((toast) => toast.text);

beforeEach(() => {
  vi.clearAllMocks();
  stage.mockImplementation((path) => Promise.resolve({ names: [path] }));
  take.mockResolvedValue({ names: ["added/a.urdf"], problems: [] });
  useToasts.setState({ toasts: [] });
});

test("all files are sent with their places, then taken", async () => {
  await addAssets([file("a/a.urdf"), file("a/mesh/b.obj")]);
  expect(stage.mock.calls.map(([path]) => path)).toEqual(["a/a.urdf", "a/mesh/b.obj"]);
  expect(take).toHaveBeenCalledOnce();
  expect(said()).toEqual(["Added added/a.urdf."]);
  expect(useToasts.getState().toasts[0]?.undo).toBe(true);
});

test("files of the system are left out; nothing but such files is no upload", async () => {
  await addAssets([file("a/.DS_Store"), file("__MACOSX/a.urdf")]);
  expect(stage).not.toHaveBeenCalled();
  expect(take).not.toHaveBeenCalled();
  expect(said()).toEqual(["There are no files to add."]);
});

test("a file that is refused keeps no other from going, and is reported", async () => {
  stage.mockRejectedValueOnce(problem(413));
  await addAssets([file("big.obj"), file("a.urdf")]);
  expect(take).toHaveBeenCalledOnce();
  expect(said()).toEqual(["big.obj: too large", "Added added/a.urdf."]);
});

test("if every file is refused, nothing is taken", async () => {
  stage.mockRejectedValue(problem(413));
  await addAssets([file("big.obj"), file("bigger.obj")]);
  expect(take).not.toHaveBeenCalled();
  expect(said()).toEqual(["big.obj: too large (and 1 more file)"]);
});

test("without a server it ends at once", async () => {
  stage.mockRejectedValue(problem(0));
  await addAssets([file("a.obj"), file("b.obj")]);
  expect(stage).toHaveBeenCalledOnce();
  expect(take).not.toHaveBeenCalled();
});

test("one can stop between files", async () => {
  stage.mockImplementation((path) => {
    stopUpload();
    return Promise.resolve({ names: [path] });
  });
  await addAssets([file("a.obj"), file("b.obj")]);
  expect(stage).toHaveBeenCalledOnce();
  expect(take).not.toHaveBeenCalled();
  expect(useUpload.getState().sending).toBe(null);
});

test("one asset that cannot be read is named, and the others are there", async () => {
  take.mockResolvedValue({ names: ["added/a.urdf"], problems: ["b.urdf: mesh c.stl was not sent", "d.obj: no faces"] });
  await addAssets([file("a.urdf"), file("b.urdf"), file("d.obj")]);
  expect(said()).toEqual(["Added added/a.urdf.", "2 assets were left out; the first: b.urdf: mesh c.stl was not sent"]);
  expect(useToasts.getState().toasts[0]?.undo).toBe(true);
});

test("what the server cannot read is reported with its remedy", async () => {
  take.mockRejectedValue(problem(400));
  await addAssets([file("a.obj")]);
  expect(useToasts.getState().toasts[0]).toMatchObject({ kind: "problem", remedy: "Make it smaller." });
});
