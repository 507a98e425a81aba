
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import { leaveExtractor, selectFound, typeExtractor, useExtractor } from "./extractor";
import { useScenes } from "./scenes";
import { initialWorkspace, useWorkspace } from "./workspace";

const hull = (name: string) => ({ name }) as never;

beforeEach(() => {
  vi.useFakeTimers();
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  useScenes.setState({ scene: { asset: "a", hulls: [hull("x"), hull("y")] } as never });
  vi.spyOn(api, "select").mockImplementation(async ({ extractor }) => ({
    select: ["y", "gone"],
    sentence: extractor,
    mark: null,
  }));
  vi.spyOn(api, "generalise").mockResolvedValue({ assets: { a: [1], b: [0, 2], c: [] } });
});
afterEach(() => {
  typeExtractor("");
  vi.useRealTimers();
  vi.restoreAllMocks();
});

describe("an extractor that is typed", () => {
  it("asks once for keys in a row, and points out what it selects on the family", async () => {
    typeExtractor("Al");
    typeExtractor("All");
    await vi.runAllTimersAsync();
    expect(api.select).toHaveBeenCalledTimes(1);
    expect(useWorkspace.getState().highlight).toEqual({ what: "All", assets: { a: [1], b: [0, 2], c: [] } });
    expect(useExtractor.getState().family).toMatchObject({ hulls: 3, assets: 2 });
    leaveExtractor();
    expect(useWorkspace.getState().highlight).toBeNull();
  });

  it("leaves no asset pale, whatever was typed by then, and nothing that others point out", async () => {
    typeExtractor("All");
    await vi.runAllTimersAsync();
    typeExtractor("Is(le");
    leaveExtractor();
    expect(useWorkspace.getState().highlight).toBeNull();
    typeExtractor("All");
    await vi.runAllTimersAsync();
    const other = { what: "rule 1", assets: {} };
    useWorkspace.setState({ highlight: other });
    leaveExtractor();
    expect(useWorkspace.getState().highlight).toBe(other);
  });

  it("selects on Enter what is there, even before the answer came", async () => {
    typeExtractor("All");
    expect(await selectFound()).toBe(true);
    expect([...useWorkspace.getState().selection]).toEqual(["y"]);
  });

  it("never selects what an earlier text found", async () => {
    typeExtractor("All");
    await vi.runAllTimersAsync();
    vi.mocked(api.select).mockResolvedValue({ select: ["x"], sentence: "", mark: null });
    typeExtractor("Is(leg)");
    await selectFound();
    expect([...useWorkspace.getState().selection]).toEqual(["x"]);
  });

  it("selects nothing while it is wrong", async () => {
    const mark = { line: 1, column: 4, message: "unknown label" };
    vi.mocked(api.select).mockResolvedValue({ select: [], sentence: "", mark });
    typeExtractor("Is(x)");
    expect(await selectFound()).toBe(false);
    expect(useExtractor.getState().found?.mark).toEqual(mark);
  });

  it("tells what the server says of it", async () => {
    const problem = { message: "the asset is gone", where: null, remedy: null, conflict: false };
    vi.mocked(api.select).mockRejectedValue(new ServerProblem(problem, 404));
    typeExtractor("All");
    await vi.runAllTimersAsync();
    expect(useExtractor.getState().found?.mark?.message).toBe("the asset is gone");
  });
});
