import { describe, expect, it } from "vitest";
import { emptyProject, useProject } from "./project";
import { sampleAction, sampleCall } from "./sample.test-help";
import { actionOf, withoutStep, withStep } from "./steps";

describe("changes to steps", () => {
  const step = { select: ["a"], action: sampleCall() };

  it("leaves the rules before open, with what other assets do there", () => {
    const rules = [{ rule: 1, action: sampleAction("Merge", { each: true }), shown: [], nothing: [] }];
    useProject.setState({ project: { ...emptyProject.project, rules } });
    expect(withStep(2, step)([])).toEqual([{ select: null, action: { ...sampleCall("Merge"), each: true } }, { select: null, action: sampleCall() }, step]);
    expect(actionOf(5).name).toBe("Delete");
  });

  it("puts a step in the place of the one before", () => {
    expect(withStep(0, step)([{ select: [], action: sampleCall("Merge") }])).toEqual([step]);
  });

  it("takes the last step away, and leaves another one open", () => {
    const other = { select: ["b"], action: sampleCall("Merge") };
    expect(withoutStep(1)([step, other])).toEqual([step]);
    expect(withoutStep(0)([step, other])).toEqual([{ select: null, action: sampleCall() }, other]);
  });
});
