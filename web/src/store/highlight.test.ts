// Hulls that are pointed out while the pointer is over what is about them.
import { beforeEach, describe, expect, it } from "vitest";
import { clearStepHighlight, highlightStep } from "./highlight";
import { emptyProject, useProject } from "./project";
import { initialWorkspace, setHighlight, useWorkspace } from "./workspace";

const view = { asset: "a", hulls: [{ name: "x" }, { name: "y" }] } as never;
const highlight = () => useWorkspace.getState().highlight;

beforeEach(() => {
  useWorkspace.setState(initialWorkspace, true);
  const reach = { a: { asset: "a", rules: [[0], [1]], error: null }, b: { asset: "b", rules: [[4, 5], []], error: null } };
  useProject.setState({ ...emptyProject, reach: reach as never }, true);
});

describe("pointing at a step", () => {
  it("points out its hulls here, and on the others what its rule selects", () => {
    highlightStep(view, ["y"], 0);
    expect(highlight()?.assets).toEqual({ a: [1], b: [4, 5] });
  });

  it("points out what it says here, not what the program makes of it", () => {
    highlightStep(view, ["y", "y~1"], 1);
    expect(highlight()?.assets["a"]).toEqual([1]);
  });

  it("points out nothing on the others where it is of this asset alone", () => {
    highlightStep(view, ["x"]);
    expect(highlight()?.assets).toEqual({ a: [0], b: [] });
  });

  it("leaves what is pointed out where there is nothing of its own", () => {
    setHighlight({ what: "leg", assets: { a: [1] } });
    highlightStep(view, []);
    expect(highlight()?.what).toBe("leg");
  });
});

it("ends its own highlight, and no other", () => {
  highlightStep(view, ["x"]);
  clearStepHighlight();
  expect(highlight()).toBeNull();
  setHighlight({ what: "rule 2", assets: {} });
  clearStepHighlight();
  expect(highlight()?.what).toBe("rule 2");
});
