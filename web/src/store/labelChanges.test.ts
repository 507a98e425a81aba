
import { beforeEach, describe, expect, it, vi } from "vitest";
import type { LabelUpdate } from "../wire";
import {
  countChanges,
  dismissLabelChanges,
  labelChangesOf,
  openNextChange,
  watchLabelChanges,
} from "./labelChanges";
import { emptyProject, receive, useProject } from "./project";
import { initialWorkspace, useWorkspace } from "./workspace";

const found: LabelUpdate = {
  way: "label-all",
  assets: [
    { asset: "a", new: [0, 1], changed: [], was: [] },
    { asset: "c", new: [2], changed: [0], was: ["leg"] },
  ],
};

beforeEach(() => {
  useProject.setState({ ...emptyProject, order: ["a", "b", "c"] }, true);
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  receive({ kind: "relabelled", relabelled: found });
});

describe("what the last edit of all labels changed", () => {
  it("is counted by hulls and assets", () => {
    expect(countChanges(found, "new")).toEqual({ hulls: 3, assets: 2 });
    expect(countChanges(found, "changed")).toEqual({ hulls: 1, assets: 1 });
  });

  it("leads from asset to asset", () => {
    openNextChange(found, "new");
    expect(useWorkspace.getState().asset).toBe("c");
    openNextChange(found, "new");
    expect(useWorkspace.getState().asset).toBe("a");
    openNextChange(found, "changed");
    openNextChange(found, "changed");
    expect(useWorkspace.getState().asset).toBe("c");
  });

  it("is gone with the next edit", () => {
    expect(labelChangesOf("c")?.was).toEqual(["leg"]);
    receive({ kind: "relabelled", relabelled: null });
    expect(labelChangesOf("c")).toBeNull();
  });

  it("is dismissed, until it comes anew", () => {
    const changed = vi.fn();
    const stop = watchLabelChanges(changed);
    dismissLabelChanges();
    expect(labelChangesOf("a")).toBeNull();
    expect(changed).toHaveBeenCalledTimes(1);
    receive({ kind: "relabelled", relabelled: { ...found } });
    expect(labelChangesOf("a")?.new).toEqual([0, 1]);
    stop();
    dismissLabelChanges();
    expect(changed).toHaveBeenCalledTimes(2);
  });
});
