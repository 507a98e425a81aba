// Exceptions of a group, and what a reply with them says.
import { expect, test } from "vitest";
import { sampleQuestion } from "../../store/sample.test-help";
import { groupText, nextException } from "./GroupHulls";

const hulls = ["a", "a", "b", "c"].map((asset, place) => ({ asset, hull: `h${place}`, place }));

test("an asset goes from one label to the next, is left out, and is as the others again", () => {
  const labels = ["leg", "panel", "misc"];
  const seen: object[] = [];
  for (let now = {}, k = 0; k < 4; k++) seen.push((now = nextException(now, "a", labels)));
  expect(seen).toEqual([{ a: "panel" }, { a: "misc" }, { a: null }, {}]);
  expect(nextException({ b: null }, "a", ["leg"])).toEqual({ a: null, b: null });
});

test("the reply says how many hulls get which label", () => {
  const question = sampleQuestion({ hulls });
  expect(groupText(question, "leg", { b: "panel" })).toBe("3 leg, 1 panel");
  expect(groupText(question, "leg", { a: null, c: "panel" })).toBe("1 leg, 1 panel; 2 left out");
  expect(groupText(question, "leg", { a: null, b: null, c: null })).toBe("4 left out");
});
