import { expect, it } from "vitest";
import { pressedKeys } from "./command";

const event = (key: string, code: string, more: Partial<Record<"ctrlKey" | "metaKey" | "altKey" | "shiftKey", boolean>> = {}) => ({
  key,
  code,
  ctrlKey: false,
  metaKey: false,
  altKey: false,
  shiftKey: false,
  ...more,
});

it.each([
  [event("g", "KeyG"), "G"],
  [event("Z", "KeyZ", { ctrlKey: true, shiftKey: true }), "Ctrl+Shift+Z"],
  [event("z", "KeyZ", { metaKey: true }), "Ctrl+Z"],
  [event("?", "Slash", { shiftKey: true }), "?"],
  [event("å", "KeyA", { altKey: true }), "Alt+A"],
  [event("1", "Numpad1"), "Numpad1"],
  [event("1", "Digit1"), "1"],
  [event(" ", "Space"), "Space"],
  [event("Tab", "Tab", { shiftKey: true }), "Shift+Tab"],
  [event(".", "Period"), "."],
])("names the keys of %o", (given, name) => {
  expect(pressedKeys(given)).toBe(name);
});
