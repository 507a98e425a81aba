import { expect, test } from "vitest";
import type { GoalResultView } from "../wire";
import { badgesOf } from "../family/cardText";
import { countSigned, leftText, moodOf, signedText } from "./assessment";
import { countGoal, freeName, goalText, openText } from "./goals";
import { listExportable, groupOf, listAcceptable } from "./reviews";
import { sampleAssessment, sampleCard, sampleRow } from "./sample.test-help";

const goal = (outcome: GoalResultView["outcome"], accepted = false): GoalResultView => ({ name: "grip", goal: "graspable(Is(handle))", outcome, why: outcome === "failed" ? "no grip" : "", hulls: [], before: null, accepted, fails: outcome === "failed" && !accepted, is_open: outcome === null || (outcome === "failed" && !accepted), picture: null });
const card = (asset: string, one: GoalResultView, excluded: "not solved" | null = null) => sampleCard({ asset, output: "edited", goals: [one], excluded });

const family = [card("a", goal("passed")), card("b", goal("failed")), card("c", goal("failed", true)), card("d", goal(null)), card("e", goal("untried")), card("f", goal("failed"), "not solved")];
const cards = Object.fromEntries(family.map((one) => [one.asset, one]));

test("a goal that fails or was not tried is open, and nothing is good with one", () => {
  const open = openText({ cards });
  expect(open).toBe("goals fail on 1 result, were not tried on 1");
  expect([moodOf(sampleAssessment(2, 0), open), leftText(sampleAssessment(2, 0), open)]).toEqual(["warn", `${open}.`]);
  expect(openText({ cards: Object.fromEntries(Object.entries(cards).filter(([asset]) => "acef".includes(asset))) })).toBeNull();
});

test("it is counted, said in words, flagged, and never signed off but by a person", () => {
  expect(countGoal(family, "grip")).toEqual({ holds: 1, accepted: 1, away: 1, untried: 1, fails: ["b"] });
  expect(family.map(({ goals: [one] }) => one && goalText(one)).slice(0, 4)).toEqual(["holds", "fails: no grip", "fails: no grip; accepted all the same", "was not tried"]);
  expect(family.map((one) => groupOf(one))).toEqual(["open", "flagged", "open", "open", "open", "excluded"]);
  const sure = Object.fromEntries(family.map(({ asset }) => [asset, sampleRow({ asset })]));
  const assessment = sampleAssessment(6, 0, { assets: family.map(({ asset }) => sampleRow({ asset, reviewed: asset === "c" })) });
  expect(signedText(assessment, countSigned(assessment, cards))).toBe("Signed off 3 of 6");
  expect(countSigned({ ...assessment, assets: [sampleRow({ asset: "d", reviewed: true })] }, cards)).toBe(1);
  expect(listExportable(family.slice(0, 5), sure).signed.length).toBe(3);
  expect(listAcceptable(family, sure)).not.toContain("b");
});

test("what was accepted and changed since is open, no longer accepted, and not counted as signed off", () => {
  const rows = [[], ["software"], ["labels", "program"]].map((stale, k) => sampleCard({ asset: `t${k}`, output: "edited", review: "accepted", stale }));
  const cards = Object.fromEntries(rows.map((one) => [one.asset, one]));
  const assessment = sampleAssessment(3, 0, { assets: rows.map(({ asset }) => sampleRow({ asset })) });
  const standing = { ...assessment, assets: rows.map(({ asset }) => sampleRow({ asset, reviewed: true })) }; // which comes out the same
  expect(signedText(standing, countSigned(standing, cards))).toBe("Signed off 3 of 3");
  expect([signedText(assessment, countSigned(assessment, cards)), moodOf(assessment, openText({ cards }))]).toEqual(["Signed off 2 of 3", "warn"]);
  expect(openText({ cards })).toBe("1 result changed since you accepted it");
  expect(rows.map((card) => badgesOf(card).some(({ name }) => name === "accepted"))).toEqual([true, true, false]);
});

test("a proposed name is free", () => {
  const goals = ["grip", "grip_2"].map((name) => ({ name, text: "", sentence: "", call: null, error: null }));
  expect([freeName("grip", goals, null), freeName("grip", goals, "grip"), freeName("hold", goals, null)]).toEqual(["grip_3", "grip", "hold"]);
});
