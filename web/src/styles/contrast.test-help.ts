// The tokens of both themes, and contrast (WCAG 2.2, 1.4.3), for tests.
import { readFileSync } from "node:fs";

const css = readFileSync(new URL("./tokens.css", import.meta.url), "utf8");
const tokens = (block: string | undefined): Record<string, string> =>
  Object.fromEntries([...(block ?? "").matchAll(/--([\w-]+):\s*(#[0-9a-f]{6});/g)].map(([, name, value]) => [name, value]));

export const light = tokens(/:root \{([^}]*)\}/.exec(css)?.[1]);
/** The dark theme's own tokens. */
export const ownDark = tokens(/:root\[data-theme="dark"\] \{([^}]*)\}/.exec(css)?.[1]);
export const dark = { ...light, ...ownDark };

/** The parts of a colour `#rrggbb` as light has them, in 0..1. */
export function linear(hex: string): number[] {
  return [1, 3, 5].map((at) => {
    const part = parseInt(hex.slice(at, at + 2), 16) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  });
}

export const luminance = ([r = 0, g = 0, b = 0]: readonly number[]): number => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/** Of two luminances. */
export const ratio = (a: number, b: number): number => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);

export const contrast = (a: string, b: string): number => ratio(luminance(linear(a)), luminance(linear(b)));
