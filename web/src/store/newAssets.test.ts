import { describe, expect, it } from "vitest";
import type { Job } from "../wire";
import { linesOfNew, newAssetsText, rebuildChoiceText } from "./newAssets";

const none = { ids: [], rebuilt: 0, min_confidence: null, unclear: null };

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
    expect(rebuildChoiceText({ ...none, ids: ["a"] })).toBeNull();
    const one = { ...none, ids: ["a"], rebuilt: 1, min_confidence: 0.9 };
    expect(rebuildChoiceText(one)).toBe("Rebuild their bodies where a hull spans parts, from 90% on");
  });

  it("are the lines of a run that say what was done before", () => {
    const line = { asset: "a", status: "edited", text: "", before: [] } as const;
    const rebuilt = { ...line, asset: "b", before: ["base holds seat and leg, 94%: base rebuilt into seat (99%), leg (97%)"] };
    expect(linesOfNew({ lines: [line, rebuilt] } as unknown as Job)).toEqual([rebuilt]);
  });
});
