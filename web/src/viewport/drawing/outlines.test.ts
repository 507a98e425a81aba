// The law of outlines: on every colour that a hull or the ground can have, the line or its casing stands out by 3 to 1
// (WCAG 2.2, 1.4.11), in both themes, and so do both from each other.
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { PALETTE } from "../../pictures/hullColors";
import { contrast, dark, light, linear, luminance, ratio } from "../../styles/contrast.test-help";
import { OUTLINES } from "./outlines";

const python = readFileSync(new URL("../../../../src/meshforge/rendering/colors.py", import.meta.url), "utf8");
const LABELS = [...(/LABEL_COLORS = \(([^)]*)\)/.exec(python)?.[1] ?? "").matchAll(/#[0-9A-F]{6}/g)].map(([hex]) => hex.toLowerCase());
const TOKENS = { ringDark: "ring-dark", ringLight: "ring-light", ringMade: "ring-made", ringRemoved: "ring-removed" } as const;
/** Of the light on a face: from the darkest to the brightest (LIGHT in hullShader.ts). */
const LIGHTS = [0.3, 0.45, 0.6, 0.8, 1, 1.22];

it("labels have colours", () => {
  expect(LABELS).toHaveLength(24);
});

describe.each([
  ["light", light],
  ["dark", dark],
] as const)("in the %s theme", (_, theme) => {
  const grounds = ["viewport-top", "viewport-bottom", "hull-unlabelled", "hull-pale", "hull-opaque", "preview", "removed", "highlight"];
  const colors = [...LABELS, ...PALETTE, ...grounds.map((name) => theme[name] ?? "")];
  const lit = colors.flatMap((color) => LIGHTS.map((share) => luminance(linear(color).map((part) => Math.min(1, part * share)))));

  describe.each(Object.entries(OUTLINES))("the outline of what is %s", (_name, { inks, width, casing }) => {
    const [line = "", rim = ""] = inks.map((ink) => theme[TOKENS[ink]]);

    it("stands out from every colour that a label, a face in any light, or the ground has", () => {
      const worst = Math.min(...lit.map((below) => Math.max(ratio(luminance(linear(line)), below), ratio(luminance(linear(rim)), below))));
      expect(worst).toBeGreaterThanOrEqual(3);
    });

    it("is two lines that stand out from each other, of which each can be seen", () => {
      expect(contrast(line, rim)).toBeGreaterThanOrEqual(3);
      expect(width).toBeGreaterThanOrEqual(1.2);
      expect(casing - width).toBeGreaterThanOrEqual(2);
    });
  });
});

it("what is selected, pointed at and about to change can be told apart without colours", () => {
  const look = ({ inks: [line], width, dash = 0 }: (typeof OUTLINES)["made"]) => [line !== "ringDark", dash > 0, Math.round(width)].join();
  const { selected, hover, made } = OUTLINES;
  expect(new Set([selected, hover, made].map(look)).size).toBe(3);
  expect([selected.dash ?? 0, hover.dash ?? 0]).toEqual([0, 0]);
});

it("what is selected is seen as well behind other hulls", () => {
  expect(OUTLINES.selected.behind).toBe(1);
});
