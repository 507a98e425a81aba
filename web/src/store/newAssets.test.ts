import { describe, expect, it } from "vitest";
import type { Job } from "../wire";
import { linesOfNew, newAssetsText, splitChoiceText } from "./newAssets";

const none = { ids: [], split: 0, sure: null, rebuild: false, unclear: null };

describe("new assets", () => {
  it("are named where it is one, and counted otherwise", () => {
    expect(newAssetsText({ ...none, ids: ["cups/c.urdf"] })).toBe("c.urdf is new, and prepared first as the others were.");
    expect(newAssetsText({ ...none, ids: ["a", "b"] })).toBe("2 assets are new, and prepared first as the others were.");
  });

  it("say why they are not decomposed", () => {
    const unclear = "the assets were decomposed in 2 ways, so new ones are not decomposed";
    expect(newAssetsText({ ...none, unclear })).toBe("The assets were decomposed in 2 ways, so new ones are not decomposed.");
  });

  it("offer a choice only where hulls are looked at", () => {
    expect(splitChoiceText({ ...none, ids: ["a"] })).toBeNull();
    const one = { ...none, ids: ["a"], split: 1, sure: 0.9 };
    expect(splitChoiceText(one)).toBe("Split their hulls that span parts, from 90% on");
    expect(splitChoiceText({ ...one, rebuild: true })).toBe("Make bodies anew of which hulls span parts, from 90% on");
  });

  it("are the lines of a run that say what was done before", () => {
    const line = { asset: "a", status: "edited", text: "", before: [] } as const;
    const split = { ...line, asset: "b", before: ["base holds seat and leg, 94%: into seat (99%), leg (97%)"] };
    expect(linesOfNew({ lines: [line, split] } as unknown as Job)).toEqual([split]);
  });
});
