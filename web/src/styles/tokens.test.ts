// Contrast of text on its ground (WCAG 2.2, 1.4.3 and 1.4.11), in both themes.
import { expect, test } from "vitest";
import { contrast, dark, light, ownDark } from "./contrast.test-help";

const GROUNDS = ["ground", "panel", "raised", "sunken"];
const TEXT = ["text", "text-dim", "text-faint"].flatMap((text) => GROUNDS.map((ground) => [text, ground] as const));
const PAIRS = [
  ...TEXT,
  ["on-accent", "accent"],
  ["accent-text", "accent-soft"],
  ["accent-text", "panel"],
  ["text", "accent-soft"],
  ["good", "good-soft"],
  ["warn", "warn-soft"],
  ["bad", "bad-soft"],
  ["good", "panel"],
  ["warn", "panel"],
  ["bad", "panel"],
  ...["axis-x", "axis-y", "axis-z", "measure"].flatMap((ink) => ["viewport-top", "viewport-bottom"].map((ground) => [ink, ground] as const)),
] as const;
const SIGNS = ["accent", "preview", "removed", "highlight"] as const;

for (const [theme, colors] of [
  ["light", light],
  ["dark", dark],
] as const) {
  test.each(PAIRS)(`${theme}: %s can be read on %s`, (text, ground) => {
    expect(contrast(colors[text] ?? "", colors[ground] ?? "")).toBeGreaterThanOrEqual(4.5);
  });

  test.each(SIGNS)(`${theme}: %s stands out from the view's ground`, (sign) => {
    for (const ground of ["viewport-top", "viewport-bottom"])
      expect(contrast(colors[sign] ?? "", colors[ground] ?? "")).toBeGreaterThanOrEqual(3);
  });
}

test("the dark theme has every colour of its own", () => {
  expect(Object.keys(ownDark).sort()).toEqual(Object.keys(light).sort());
});
