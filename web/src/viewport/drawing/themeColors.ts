// The colours of the theme as three.js needs them, read anew when the theme changes.
import { Color } from "three";

const NAMES = {
  accent: "--accent",
  selected: "--highlight",
  ringDark: "--ring-dark",
  ringLight: "--ring-light",
  ringMade: "--ring-made",
  ringRemoved: "--ring-removed",
  preview: "--preview",
  removed: "--removed",
  unlabelled: "--hull-unlabelled",
  pale: "--hull-pale",
  line: "--line-strong",
  text: "--text",
  warn: "--warn",
} as const;

export type ThemeColors = Readonly<Record<keyof typeof NAMES, Color>> & { readonly dark: boolean };

export function readThemeColors(): ThemeColors {
  const style = getComputedStyle(document.documentElement);
  const colors = Object.entries(NAMES).map(([name, token]) => [name, new Color(style.getPropertyValue(token).trim())]);
  const dark = document.documentElement.dataset["theme"] === "dark";
  return { ...(Object.fromEntries(colors) as Record<keyof typeof NAMES, Color>), dark };
}
