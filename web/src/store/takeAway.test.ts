// Files that the server makes and the browser saves.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import { saveFrom } from "../server/save";
import type { ConfidenceView, Job } from "../wire";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { describeResults, saveFile, takeAway } from "./takeAway";
import { useToasts } from "./toasts";

vi.mock("../server/save", () => ({ saveFrom: vi.fn() }));

const job = (state: Job["state"]): Job => ({
  id: "download-1", kind: "download", title: "", done: 0, total: 2, doing: "", state, message: "", lines: [], out: "t.zip",
}); // prettier-ignore
const show = (...jobs: Job[]) => useProject.setState({ jobs });
const held = (asset: string): ConfidenceView => ({ asset, probability: 0.5, reasons: [], state: "needs review", reviewed: false });

beforeEach(() => {
  useProject.setState(emptyProject, true);
  useToasts.setState({ toasts: [] });
  vi.mocked(saveFrom).mockClear();
  vi.spyOn(api, "startJob").mockResolvedValue(job("running"));
  vi.spyOn(api, "downloadTicket").mockResolvedValue("download/once");
});

afterEach(() => {
  vi.restoreAllMocks();
});

describe("a file to take away", () => {
  it("is asked for as the server has it, and saved once it is made", async () => {
    const taking = takeAway({ what: "results", signed_only: false });
    await vi.waitFor(() => expect(api.startJob).toHaveBeenCalledWith({ kind: "download", what: "results", signed_only: false }));
    show(job("running"));
    await Promise.resolve();
    expect(saveFrom).not.toHaveBeenCalled();
    show(job("done"));
    await taking;
    show({ ...job("done"), done: 2 });
    expect(vi.mocked(saveFrom).mock.calls).toEqual([["download/once"]]);
  });

  it("is saved where it was made before its answer came", async () => {
    show(job("done"));
    await takeAway({ what: "report" });
    expect(saveFrom).toHaveBeenCalledOnce();
  });

  it.each(["failed", "cancelled"] as const)("that %s is not saved", async (state) => {
    show(job(state));
    await takeAway({ what: "report" });
    expect(api.downloadTicket).not.toHaveBeenCalled();
  });

  it("goes with its project", async () => {
    const taking = takeAway({ what: "report" });
    await vi.waitFor(() => expect(api.startJob).toHaveBeenCalled());
    await Promise.resolve();
    show(job("running"));
    show();
    await taking;
    expect(saveFrom).not.toHaveBeenCalled();
  });

  it("that is not kept any more is reported", async () => {
    const gone = { message: "this file is not kept any more", where: null, remedy: "Make it again.", conflict: false };
    vi.mocked(api.downloadTicket).mockRejectedValue(new ServerProblem(gone, 404));
    await saveFile("download-1");
    expect(useToasts.getState().toasts.map(({ text, remedy }) => [text, remedy])).toEqual([[gone.message, gone.remedy]]);
  });
});

describe("what a zip will hold", () => {
  const cards = [
    sampleCard({ asset: "a", output: "edited", review: "accepted" }),
    sampleCard({ asset: "b", output: "edited" }),
    sampleCard({ asset: "c", output: "unchanged" }),
    sampleCard({ asset: "d", output: "failed" }),
    sampleCard({ asset: "e", output: "none" }),
  ];

  it("names held results, in it or not", () => {
    const confidence = { a: held("a"), b: held("b"), d: held("d") };
    expect(describeResults(cards, confidence, true)).toBe("1 signed-off result, in a zip; 1 held is not in it");
    expect(describeResults(cards, confidence, false)).toBe("3 results, in a zip; 1 of them held");
    expect(describeResults(cards, {}, false)).toBe("3 results, in a zip");
  });
});
