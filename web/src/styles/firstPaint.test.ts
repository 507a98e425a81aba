// What the page looks like before its script runs: the ground of the theme that was chosen, or else of the system.
import { readFileSync } from "node:fs";
import { afterEach, expect, it, vi } from "vitest";

const read = (path: string) => readFileSync(new URL(path, import.meta.url), "utf8");
const page = read("../../index.html");
const script = read("../../public/theme.js");
const grounds = [...read("./tokens.css").matchAll(/--ground: (#\w+);/g)].map(([, color]) => color);

/** The theme that the script gives the page. */
function themeOf(kept: string | null, dark: boolean): string | undefined {
  const dataset: { theme?: string } = {};
  vi.stubGlobal("localStorage", { getItem: (key: string) => (key === "meshforge.desk" ? kept : null) });
  vi.stubGlobal("matchMedia", () => ({ matches: dark }));
  vi.stubGlobal("document", { documentElement: { dataset } });
  new Function(script)();
  return dataset.theme;
}

afterEach(() => vi.unstubAllGlobals());

it.each([
  [null, false, "light"],
  [null, true, "dark"],
  ['{"theme":"dark"}', false, "dark"],
  ['{"theme":"light"}', true, "light"],
  ['{"theme":"system"}', true, "dark"],
  ['{"theme":"pink"}', true, "dark"],
  ["{broken", false, "light"],
  ["7", true, "dark"],
])("kept %j, dark system %j: %s", (kept, dark, theme) => {
  expect(themeOf(kept, dark)).toBe(theme);
});

it("the ground in the page is that of the style sheet, light and dark, chosen or not", () => {
  const inPage = [...page.matchAll(/background: (#\w+);/g)].map(([, color]) => color);
  expect(grounds).toHaveLength(2);
  expect(inPage).toEqual([...grounds, ...grounds]);
});

it("the script comes before all that the page waits for, and stops it until the theme is known", () => {
  expect(page.indexOf("theme.js")).toBeGreaterThan(0);
  expect(page.indexOf("theme.js")).toBeLessThan(page.indexOf("type=\"module\""));
  expect(/<script vite-ignore src="\.\/theme\.js"><\/script>/.test(page)).toBe(true);
});
