// What the browser kept is taken back without trusting it.
import { expect, test } from "vitest";
import { initialPreferences, restore } from "./preferences";

test("what was kept comes back", () => {
  const mine = { ...initialPreferences, theme: "dark" as const, columns: { family: 300, panel: 400 } };
  expect(restore(initialPreferences, JSON.parse(JSON.stringify(mine)))).toEqual(mine);
});

test.each([[null], ["text"], [7], [[]], [{ columns: null }], [{ theme: "pink" }], [{ unit: "inch" }], [{ layout: { thumbnails: "huge" } }], [{ columns: { family: -5 } }], [{ view: { grid: "yes" } }]])(
  "what makes no sense is as it is at first: %j",
  (stored) => {
    expect(restore(initialPreferences, stored)).toEqual(initialPreferences);
  },
);

test("one bad value leaves the others", () => {
  const stored = { columns: { family: 99999, panel: 400 }, view: { ghost: true, colorBy: "smell" }, more: 1 };
  const out = restore(initialPreferences, stored);
  expect(out.columns).toEqual({ ...initialPreferences.columns, panel: 400 });
  expect(out.view).toEqual({ ...initialPreferences.view, ghost: true });
  expect(out).not.toHaveProperty("more");
});
