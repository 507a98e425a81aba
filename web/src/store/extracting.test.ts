import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import { initialDesk, useDesk } from "./desk";
import { left, takeFound, typed, useExtracting } from "./extracting";
import { useScenes } from "./scenes";

const hull = (name: string) => ({ name }) as never;

beforeEach(() => {
  vi.useFakeTimers();
  useDesk.setState({ ...initialDesk, asset: "a" }, true);
  useScenes.setState({ scene: { asset: "a", hulls: [hull("x"), hull("y")] } as never });
  vi.spyOn(api, "select").mockImplementation(async ({ extractor }) => ({
    select: ["y", "gone"],
    sentence: extractor,
    mark: null,
  }));
  vi.spyOn(api, "generalise").mockResolvedValue({ assets: { a: [1], b: [0, 2], c: [] } });
});
afterEach(() => {
  typed("");
  vi.useRealTimers();
  vi.restoreAllMocks();
});

describe("an extractor that is typed", () => {
  it("asks once for keys in a row, and points out what it selects on the family", async () => {
    typed("Al");
    typed("All");
    await vi.runAllTimersAsync();
    expect(api.select).toHaveBeenCalledTimes(1);
    expect(useDesk.getState().highlight).toEqual({ what: "All", assets: { a: [1], b: [0, 2], c: [] } });
    expect(useExtracting.getState().family).toMatchObject({ hulls: 3, assets: 2 });
    left();
    expect(useDesk.getState().highlight).toBeNull();
  });

  it("selects on Enter what is there, even before the answer came", async () => {
    typed("All");
    expect(await takeFound()).toBe(true);
    expect([...useDesk.getState().selection]).toEqual(["y"]);
  });

  it("never selects what an earlier text found", async () => {
    typed("All");
    await vi.runAllTimersAsync();
    vi.mocked(api.select).mockResolvedValue({ select: ["x"], sentence: "", mark: null });
    typed("Is(leg)");
    await takeFound();
    expect([...useDesk.getState().selection]).toEqual(["x"]);
  });

  it("selects nothing while it is wrong", async () => {
    const mark = { line: 1, column: 4, message: "unknown label" };
    vi.mocked(api.select).mockResolvedValue({ select: [], sentence: "", mark });
    typed("Is(x)");
    expect(await takeFound()).toBe(false);
    expect(useExtracting.getState().found?.mark).toEqual(mark);
  });

  it("tells what the server says of it", async () => {
    const problem = { message: "the asset is gone", where: null, remedy: null, conflict: false };
    vi.mocked(api.select).mockRejectedValue(new ServerProblem(problem, 404));
    typed("All");
    await vi.runAllTimersAsync();
    expect(useExtracting.getState().found?.mark?.message).toBe("the asset is gone");
  });
});
