// How sure edits are in words, and which question is open.
import { describe, expect, it } from "vitest";
import type { Reason, ReviewQuestionView } from "../wire";
import { doubtsText, groupHeld, leftText, moodOf, openQuestion, percentText, placesOf, probabilityText, signedText } from "./assessment";
import { filterAssets } from "./family";
import { applyEvent, emptyProject } from "./project";
import { sampleAssessment, sampleCard, sampleQuestion, sampleRow } from "./sample.test-help";

describe("how sure the family is", () => {
  it("is told by counts, and good only where nothing is held", () => {
    const told = (...family: Parameters<typeof sampleAssessment>) => [signedText(sampleAssessment(...family)), leftText(sampleAssessment(...family))];
    expect(told(75, 4)).toEqual(["Signed off 71 of 75", "4 are less than 95% sure: look at these 4."]);
    expect(told(2, 1)).toEqual(["Signed off 1 of 2", "1 is less than 95% sure: look at this one."]);
    expect(told(5, 0)).toEqual(["Signed off 5 of 5", null]);
    expect(told(5, 1, { signed_off: 2, excluded: 2 })[1]).toBe("1 is less than 95% sure: look at this one; 2 are excluded.");
    expect([sampleAssessment(5, 1), sampleAssessment(5, 0)].map((one) => moodOf(one))).toEqual(["warn", "good"]);
  });

  it("is told with the bar as it was set", () => {
    const told = [0.9999, 0.975, 0.57, 1].map((bar) => leftText(sampleAssessment(5, 1, { threshold: bar })));
    expect(told).toEqual(["99.99%", "97.5%", "57%", "100%"].map((bar) => `1 is less than ${bar} sure: look at this one.`));
  });

  it("is told reason by reason, the least probable first", () => {
    const doubt = (text: string): Reason => ({ kind: "alarm", text, hulls: [], rule: null, share: 0 });
    const rows = [
      sampleRow({ asset: "a", probability: 0.6, state: "needs review", reasons: [doubt("nobody looked"), doubt("nearly solid")] }),
      sampleRow({ asset: "b", probability: 0.1, state: "needs review", reasons: [doubt("nearly solid")] }),
      sampleRow({ asset: "c", probability: 0.3, state: "needs review", reasons: [doubt("nobody looked")] }),
      sampleRow({ asset: "d" }),
      sampleRow({ asset: "e", probability: 0.6, state: "needs review" }),
    ];
    expect(groupHeld({ assets: rows, threshold: 0.95 })).toEqual([
      { reason: "nearly solid", assets: ["b"], share: "10%" },
      { reason: "nobody looked", assets: ["c", "a"], share: "30% to 60%" },
      { reason: "", assets: ["e"], share: "60%" },
    ]);
  });

  it("is not good where some assets were not looked at", () => {
    const some = sampleAssessment(400, 0, { unseen: 9600 });
    expect([signedText(some), leftText(some)]).toEqual(["Signed off 400 of 10,000", "9,600 were not looked at."]);
    expect(leftText(sampleAssessment(5, 0, { unseen: 1 }))).toBe("1 was not looked at.");
    expect(moodOf(some)).toBe("warn");
  });

  it("never rounds up to the bar, nor to certainty", () => {
    expect([0.9496, 0.95, 0.9999, 0.62, 0.004].map((share) => percentText(share, 0.95))).toEqual(["94%", "95%", "99%", "62%", "<1%"]);
  });

  it("is no number as soon as something changed", () => {
    const known = applyEvent(emptyProject, { kind: "assessment", assessment: sampleAssessment(2, 1), assessing: false });
    const changed = applyEvent(known, { kind: "assessment", assessment: null, assessing: true });
    expect(probabilityText(known, "a0")).toBe("50%");
    expect(probabilityText(changed, "a0")).toBe("…");
    expect(probabilityText(emptyProject, "a0")).toBeNull();
    expect(probabilityText({ ...emptyProject, assessing: true }, "a0"), "while there is no program").toBeNull();
    expect(probabilityText({ ...emptyProject, assessing: true, learning: true }, "a0")).toBe("…");
    expect(doubtsText("a0", changed.confidence["a0"], null)).toBe("a0");
  });

  it("comes with the doubts, a sentence a line", () => {
    const doubt = { kind: "alarm", text: "nearly one solid block", hulls: [], rule: null } as const;
    const row = sampleRow({ probability: 0.03, reasons: [doubt as never] });
    expect(doubtsText("a", row, 0.95)).toBe("a: 3% sure\n• nearly one solid block");
  });

  it("orders and filters the family, also while it is worked out anew", () => {
    const cards = Object.fromEntries(["a", "b", "c", "d"].map((asset) => [asset, sampleCard({ asset })]));
    const confidence = {
      a: sampleRow(),
      b: sampleRow({ asset: "b", probability: 0.2, state: "needs review" }),
      c: sampleRow({ asset: "c", probability: 0.1, state: "excluded" }),
    };
    const shown = (only: readonly "needs review"[]) =>
      filterAssets(cards, Object.keys(cards), { search: "", only, sort: "probability", chosen: true }, emptyProject.project, "", confidence);
    expect(shown([])).toEqual(["b", "a", "c", "d"]);
    expect(shown(["needs review"])).toEqual(["b"]);
  });
});

describe("the question of the assessment", () => {
  it("is none while there is no program, but for labels that may be wrong and orientations", () => {
    const asked = (count: number, kind: ReviewQuestionView["kind"]) => openQuestion({ assessment: sampleAssessment(count, 0, { question: sampleQuestion({ kind }) }) });
    expect([asked(0, "group"), asked(0, "demonstrate"), openQuestion({ assessment: null })]).toEqual([null, null, null]);
    expect([asked(0, "repair"), asked(0, "orientation"), asked(1, "group")].map((one) => one?.kind)).toEqual(["repair", "orientation", "group"]);
  });

  it("has its hulls by asset", () => {
    const hulls = [{ asset: "a", hull: "x", place: 3 }, { asset: "b", hull: "y", place: 0 }, { asset: "a", hull: "z", place: 5 }];
    expect(placesOf({ hulls })).toEqual({ a: [3, 5], b: [0] });
  });
});
