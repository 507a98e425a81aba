import { beforeEach, describe, expect, it, vi } from "vitest";
import type { Relabelled } from "../wire";
import { initialDesk, useDesk } from "./desk";
import { emptyProject, receive, useProject } from "./project";
import {
  lightRelabelled,
  nextRelabelled,
  presentRelabelled,
  putAside,
  relabelledOn,
  tally,
  unlightRelabelled,
  watchRelabelled,
} from "./relabelled";

const found: Relabelled = {
  entry: 1,
  way: "propagate",
  settled: 0,
  assets: [
    { asset: "a", new: [0, 1], changed: [], was: [] },
    { asset: "c", new: [2], changed: [0], was: ["leg"] },
  ],
};

beforeEach(() => {
  useProject.setState({ ...emptyProject, order: ["a", "b", "c"] }, true);
  useDesk.setState({ ...initialDesk, asset: "a" }, true);
  receive({ kind: "relabelled", relabelled: found });
});

describe("what the last edit of all labels changed", () => {
  it("is counted by hulls and assets", () => {
    expect(tally(found, "new")).toEqual({ hulls: 3, assets: 2 });
    expect(tally(found, "changed")).toEqual({ hulls: 1, assets: 1 });
  });

  it("is pointed out in the family, and no longer", () => {
    lightRelabelled(found, "changed");
    expect(useDesk.getState().highlight?.assets).toEqual({ c: [0] });
    unlightRelabelled();
    expect(useDesk.getState().highlight).toBeNull();
  });

  it("leaves what others point out", () => {
    useDesk.setState({ highlight: { what: "rule", assets: {} } });
    unlightRelabelled();
    expect(useDesk.getState().highlight?.what).toBe("rule");
  });

  it("leads from asset to asset", () => {
    nextRelabelled(found, "new");
    expect(useDesk.getState().asset).toBe("c");
    nextRelabelled(found, "new");
    expect(useDesk.getState().asset).toBe("a");
    nextRelabelled(found, "changed");
    nextRelabelled(found, "changed");
    expect(useDesk.getState().asset).toBe("c");
  });

  it("is gone with the next edit", () => {
    expect(relabelledOn("c")?.was).toEqual(["leg"]);
    receive({ kind: "relabelled", relabelled: null });
    expect(presentRelabelled()).toBeNull();
    expect(relabelledOn("c")).toBeNull();
  });

  it("is put aside, until it comes anew", () => {
    const changed = vi.fn();
    const stop = watchRelabelled(changed);
    putAside();
    expect(presentRelabelled()).toBeNull();
    expect(changed).toHaveBeenCalledTimes(1);
    receive({ kind: "relabelled", relabelled: null });
    receive({ kind: "relabelled", relabelled: { ...found } });
    expect(relabelledOn("a")?.new).toEqual([0, 1]);
    stop();
    putAside();
    expect(changed).toHaveBeenCalledTimes(3);
  });
});
