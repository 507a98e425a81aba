// Assets that leave the family: what is sent, and which asset is open then.
import { beforeEach, describe, expect, it, vi } from "vitest";
import { perform } from "./edits";
import { leaveOut, putBack, whyNotLeave } from "./members";
import { emptyProject, useProject } from "./project";
import { assetsInView } from "./sheet";
import { initialWorkspace, useWorkspace } from "./workspace";

vi.mock("./edits", () => ({ perform: vi.fn() }));
const sent = vi.mocked(perform);

beforeEach(() => {
  vi.clearAllMocks();
  sent.mockResolvedValue(true);
  useProject.setState({ ...emptyProject, order: ["a", "b", "c"] }, true);
  useWorkspace.setState({ ...initialWorkspace, asset: "b" }, true);
});

describe("an asset that leaves the family", () => {
  it("is left out by one edit, and the next one is open then", async () => {
    await leaveOut(["b"]);
    expect(sent.mock.calls).toEqual([[{ kind: "exclude", ids: ["b"], reason: "not of this family" }]]);
    expect(useWorkspace.getState().asset).toBe("c");
  });

  it("stays open where that is refused", async () => {
    sent.mockResolvedValue(false);
    await leaveOut(["b"]);
    expect(useWorkspace.getState().asset).toBe("b");
  });

  it("leaves the person where they are, if they look at another one", async () => {
    await leaveOut(["a"]);
    expect(useWorkspace.getState().asset).toBe("b");
  });

  it("leaves with others by one edit, and the next one that stays is open then", async () => {
    useWorkspace.setState({ asset: "a", sheet: ["a", "b"] });
    await leaveOut(assetsInView(useWorkspace.getState()));
    expect(sent.mock.calls).toEqual([[{ kind: "exclude", ids: ["a", "b"], reason: "not of this family" }]]);
    expect([useWorkspace.getState().asset, useWorkspace.getState().sheet]).toEqual(["c", []]);
    expect(whyNotLeave(["a", "b", "c"])).toBe("They are all assets of the family.");
  });

  it("comes back by one edit", async () => {
    await putBack(["a", "b"]);
    expect(sent.mock.calls).toEqual([[{ kind: "exclude", ids: ["a", "b"], reason: null }]]);
  });

  it("must not be the last one, nor none", () => {
    expect(whyNotLeave(["b"])).toBe(null);
    expect(whyNotLeave([])).toBe("No asset is open.");
    useProject.setState({ order: ["b"] });
    expect(whyNotLeave(["b"])).toBe("It is the only asset of the family.");
  });
});
