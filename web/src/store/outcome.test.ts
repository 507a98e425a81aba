import { describe, expect, it } from "vitest";
import type { OutcomeView, CandidateView } from "../wire";
import { coverageOfRule, coverageText, summarizeOutcome } from "./outcome";
import { highlightOfRule } from "./highlight";
import { emptyProject } from "./project";
import { sampleAssessment } from "./sample.test-help";
import { choiceText, differing, extractorOf, learnedDiffers, readingsOf } from "./readings";

const outcome = (more: Partial<OutcomeView>): OutcomeView => ({
  number: 1,
  status: "found",
  program: "Is(a) => Delete",
  rules: [],
  looked_at: 0,
  unambiguous: false,
  candidates: [],
  repairs: 0,
  nearest: null,
  why: null,
  advice: [],
  stale: [],
    overruled: [],
  error: null,
  ...more,
});
const reading = (more: Partial<CandidateView>): CandidateView => ({
  id: "r",
  rule: 1,
  extractor: "Is(a)",
  sentence: "",
  size: 1,
  belief: 0.5,
  differs_on: [],
  ...more,
});
const reach = {
  one: { asset: "one", rules: [[0, 2], []], before: 3, after: 1, error: null },
  two: { asset: "two", rules: [[], [1]], before: 2, after: 2, error: null },
  three: { asset: "three", rules: [], before: 2, after: 0, error: "no leg" },
};

describe("the summary of a outcome", () => {
  it("names a way on where learning failed", () => {
    const { title, more } = summarizeOutcome(outcome({ status: "error", error: "its process died", program: null }), 3);
    expect(title).toBe("Learning failed");
    expect(more).toMatch(/^its process died\nLearn again\. .*undo/);
  });

  it("says that all readings agree once it is unambiguous", () => {
    const sure = { assessment: sampleAssessment(60, 0), assessing: false };
    const said = summarizeOutcome(outcome({ unambiguous: true, looked_at: 60 }), 60, sure);
    expect(said).toEqual({ mood: "good", title: "Signed off 60 of 60", more: "All readings select the same hulls on your 60 assets." });
  });

  it("says so where not all assets were looked at", () => {
    const said = summarizeOutcome(outcome({ unambiguous: true, looked_at: 400 }), 12_000, { assessment: sampleAssessment(400, 4), assessing: false });
    expect(said).toMatchObject({ mood: "warn", title: "Signed off 396 of 400" });
    expect(said.more).toBe("4 are less than 95% sure: look at these 4.\nAll readings select the same hulls on the 400 assets looked at, of your 12,000 assets.");
    const spread = { hulls: 12, assets: 9, lookedAt: 400 };
    expect([coverageText(spread, 12_000), coverageText(spread, 400), coverageText({ ...spread, hulls: 0 }, 400)]).toEqual([
      "12 hulls on 9 assets of the 400 looked at",
      "12 hulls on 9 assets",
      "selects nothing on any asset",
    ]);
  });

  it("names where a less believable reading differs", () => {
    const readings = [reading({ differs_on: ["a/x", "a/y"] }), reading({ rule: 2, belief: 0.001, differs_on: ["z"] })];
    expect(summarizeOutcome(outcome({ candidates: readings }), 3, { assessment: sampleAssessment(3, 1), assessing: false }).more).toContain("\nRule 1 may select other hulls on x and y.");
  });

  it("says nothing good of a program of which it is not known how sure it is", () => {
    expect(summarizeOutcome(outcome({ unambiguous: true }), 3, { assessment: null, assessing: true })).toMatchObject({ mood: "plain" });
    expect(summarizeOutcome(outcome({ unambiguous: true }), 3)).toMatchObject({ mood: "plain", more: "How sure its edits are is not known." });
  });

  it("has words for every outcome", () => {
    const statuses = ["found", "ambiguous", "repair", "none", "timeout", "error"] as const;
    const titles = statuses.map((status) => summarizeOutcome(outcome({ status, why: "so", error: "broken" }), 2).title);
    expect(new Set(titles).size).toBe(statuses.length);
    expect(summarizeOutcome(null, 2).title).toBe("No demonstration yet");
  });

  it("gives the reason why there is no program", () => {
    const said = summarizeOutcome(outcome({ status: "none", why: "rule 2 takes two alike hulls apart" }), 2);
    expect(said).toMatchObject({ mood: "bad", more: "rule 2 takes two alike hulls apart" });
  });
});

describe("what a rule reaches", () => {
  it("is highlighted on the assets on which the program runs", () => {
    expect(highlightOfRule(reach, 1)).toEqual({ what: "rule 1", assets: { one: [0, 2], two: [] } });
  });

  it("is counted in hulls and in assets that have some", () => {
    expect(coverageOfRule(reach, 1)).toEqual({ hulls: 2, assets: 1, lookedAt: 3 });
    expect(coverageOfRule({}, 1)).toBeNull();
  });
});

describe("readings and programs", () => {
  it("puts the reading of the program first, then by belief", () => {
    const readings = [reading({ extractor: "Is(b)", belief: 0.2 }), reading({ extractor: "Is(c)", belief: 0.3 }), reading({ belief: 0.1 })];
    const rule = { rule: 1, text: "Is(a)   => Delete", sentence: "", candidates: 3 };
    expect(readingsOf(outcome({ candidates: readings }), rule).map((row) => row.extractor)).toEqual(["Is(a)", "Is(c)", "Is(b)"]);
  });

  it("does not take an arrow in a label for the end of an extractor", () => {
    expect(extractorOf('Is("a => b")  => Delete')).toBe('Is("a => b")');
    expect(extractorOf("All => Merge as x")).toBe("All");
  });

  it("tells a learned program from one by hand, but not by blank lines at its end", () => {
    const program = { ...emptyProject.program, text: "Is(a) => Delete\n" };
    expect(learnedDiffers(program, outcome({}))).toBe(false);
    expect(learnedDiffers(program, outcome({ program: "Is(b) => Delete" }))).toBe(true);
    expect(learnedDiffers(program, outcome({ program: null }))).toBe(false);
  });
});

describe("choices of a question", () => {
  const choice = (...select: string[]) => ({ reading: select.join(), extractor: "", sentence: "", select });

  it("differ by names that are not in all of them", () => {
    expect(differing([["a", "b"], ["b", "c"], ["b"]])).toEqual(["a", "c"]);
    expect(differing([["a"], ["a"]])).toEqual([]);
  });

  it("are told by how they differ from the first, where that is shorter", () => {
    const choices = [choice("a", "b", "c"), choice("a", "b", "c", "d"), choice("b", "c", "e"), choice("x"), choice()];
    expect(choices.map((_, k) => choiceText(choices, k))).toEqual([
      "3 hulls",
      "4 hulls: those of 1 and d",
      "3 hulls: those of 1 and e, without a",
      "1 hull",
      "No hull",
    ]);
  });
});
