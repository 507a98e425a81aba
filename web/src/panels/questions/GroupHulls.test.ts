// Exceptions of a group, and what a reply with them says.
import { expect, test } from "vitest";
import { sampleQuestion } from "../../store/sample.test-help";
import { groupText, nextException } from "./GroupHulls";

const hulls = ["a", "a", "b", "c"].map((asset, place) => ({ asset, hull: `h${place}`, place }));

test("a hull goes from one label to the next, is left out, and is as the others again; so do all of an asset with it", () => {
  const labels = ["leg", "panel", "misc"];
  const seen: object[] = [];
  for (let now = {}, k = 0; k < 4; k++) seen.push((now = nextException(now, ["a#h0"], labels)));
  expect(seen).toEqual([{ "a#h0": "panel" }, { "a#h0": "misc" }, { "a#h0": null }, {}]);
  expect(nextException({ "b#h2": null, "a#h1": "misc" }, ["a#h0", "a#h1"], labels)).toEqual({ "b#h2": null, "a#h0": "panel", "a#h1": "panel" });
});

test("the reply says how many hulls get which label", () => {
  const question = sampleQuestion({ hulls });
  expect(groupText(question, "leg", { "a#h1": "panel" })).toBe("3 leg, 1 panel");
  expect(groupText(question, "leg", { "a#h0": null, "c#h3": "panel" })).toBe("2 leg, 1 panel; 1 left out");
  expect(groupText(question, "leg", Object.fromEntries(hulls.map(({ asset, hull }) => [`${asset}#${hull}`, null])))).toBe("4 left out");
});
