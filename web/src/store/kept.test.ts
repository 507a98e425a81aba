// What the browser kept is taken back without trusting it.
import { expect, test } from "vitest";
import { initialKept, restored } from "./kept";

test("what was kept comes back", () => {
  const mine = { ...initialKept, theme: "dark" as const, columns: { family: 300, panel: 400 } };
  expect(restored(initialKept, JSON.parse(JSON.stringify(mine)))).toEqual(mine);
});

test.each([[null], ["text"], [7], [[]], [{ columns: null }], [{ theme: "pink" }], [{ columns: { family: -5 } }], [{ view: { grid: "yes" } }]])(
  "what makes no sense is as it is at first: %j",
  (stored) => {
    expect(restored(initialKept, stored)).toEqual(initialKept);
  },
);

test("one bad value leaves the others", () => {
  const stored = { columns: { family: 99999, panel: 400 }, view: { ghost: true, colorBy: "smell" }, more: 1 };
  const out = restored(initialKept, stored);
  expect(out.columns).toEqual({ ...initialKept.columns, panel: 400 });
  expect(out.view).toEqual({ ...initialKept.view, ghost: true });
  expect(out).not.toHaveProperty("more");
});
