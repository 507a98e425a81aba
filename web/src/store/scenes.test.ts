// What an asset is, asked of the server no more often than it can have changed.
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { ShapesPacket } from "../server/packet";
import type { AssetView } from "../wire";
import { emptyProject, useProject } from "./project";
import { getDetails, prefetch, showScene, useScenes } from "./scenes";
import { useToasts } from "./toasts";

const problem = { message: "this file cannot be read", where: "a.obj", remedy: null, conflict: false };
const view = { hulls: [], non_convex: [], contacts: [] } as unknown as AssetView;
const packet = { rows: [], shapes: [] } as unknown as ShapesPacket;
const revised = (asset: string, by: number) =>
  useProject.setState({ revisions: { [asset]: by }, shapeRevisions: { [asset]: by } });

beforeEach(() => useProject.setState(emptyProject, true));
afterEach(() => vi.restoreAllMocks());

test("who asks at the same time, and later, gets one answer", async () => {
  const [asset, shapes] = [vi.spyOn(api, "asset").mockResolvedValue(view), vi.spyOn(api, "shapes").mockResolvedValue(packet)];
  const [one, other] = await Promise.all([getDetails("good"), getDetails("good")]);
  expect(one).toBe(other);
  expect(await getDetails("good")).toBe(one);
  expect([asset.mock.calls.length, shapes.mock.calls.length]).toEqual([1, 1]);
});

test("an asset that cannot be read is asked for once per revision, and reported in the view alone", async () => {
  const failing = () => Promise.reject(new ServerProblem(problem, 400));
  const [asset, shapes] = [vi.spyOn(api, "asset").mockImplementation(failing), vi.spyOn(api, "shapes").mockImplementation(failing)];
  prefetch("bad");
  await showScene("bad", { kind: "source" });
  await expect(getDetails("bad")).rejects.toThrow("cannot be read");
  expect(useScenes.getState().problem).toEqual(problem);
  expect(useToasts.getState().toasts).toEqual([]);
  expect([asset.mock.calls.length, shapes.mock.calls.length]).toEqual([1, 1]);
  revised("bad", 1);
  await expect(getDetails("bad")).rejects.toThrow("cannot be read");
  expect([asset.mock.calls.length, shapes.mock.calls.length]).toEqual([2, 2]);
});

test("what was mended is there again", async () => {
  vi.spyOn(api, "shapes").mockResolvedValue(packet);
  const asset = vi.spyOn(api, "asset").mockRejectedValueOnce(new ServerProblem(problem, 400)).mockResolvedValue(view);
  await expect(getDetails("mended")).rejects.toThrow();
  revised("mended", 1);
  expect((await getDetails("mended")).view).toBe(view);
  expect(asset).toHaveBeenCalledTimes(2);
});

test("a server that did not answer is asked again", async () => {
  vi.spyOn(api, "shapes").mockResolvedValue(packet);
  vi.spyOn(api, "asset").mockRejectedValueOnce(new ServerProblem(problem, 0)).mockResolvedValue(view);
  await expect(getDetails("lost")).rejects.toThrow();
  expect((await getDetails("lost")).view).toBe(view);
});
