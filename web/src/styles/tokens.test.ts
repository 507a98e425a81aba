// Contrast of text on its ground (WCAG 2.2, 1.4.3 and 1.4.11), in both themes.
import { readFileSync } from "node:fs";
import { expect, test } from "vitest";

const css = readFileSync(new URL("./tokens.css", import.meta.url), "utf8");
const tokens = (block: string | undefined) =>
  Object.fromEntries([...(block ?? "").matchAll(/--([\w-]+):\s*(#[0-9a-f]{6});/g)].map(([, name, value]) => [name, value]));
const light = tokens(/:root \{([^}]*)\}/.exec(css)?.[1]);
const dark = { ...light, ...tokens(/:root\[data-theme="dark"\] \{([^}]*)\}/.exec(css)?.[1]) };

function luminance(hex: string): number {
  const [r = 0, g = 0, b = 0] = [1, 3, 5].map((at) => {
    const part = parseInt(hex.slice(at, at + 2), 16) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [low = 0, high = 0] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

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
const SIGNS = ["accent", "outline-selected", "preview", "removed", "highlight"] as const;

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
  expect(Object.keys(tokens(/:root\[data-theme="dark"\] \{([^}]*)\}/.exec(css)?.[1])).sort()).toEqual(Object.keys(light).sort());
});
