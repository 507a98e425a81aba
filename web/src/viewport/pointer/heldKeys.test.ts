// Keys that are held during a drag count for it alone; pressed by themselves they switch.
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { initialWorkspace, useWorkspace } from "../../store/workspace";
import { noteDrag, watchHeldKeys } from "./heldKeys";

let listeners: Map<string, (event: unknown) => void>;
let stop: () => void;
const key = (kind: "keydown" | "keyup", pressed: string, code: string) =>
  listeners.get(kind)?.({ key: pressed, code, repeat: false, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false });

beforeEach(() => {
  listeners = new Map();
  vi.stubGlobal("window", { addEventListener: (kind: string, does: (event: unknown) => void) => listeners.set(kind, does) });
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  stop = watchHeldKeys();
});
afterEach(() => {
  stop();
  vi.unstubAllGlobals();
});

it("selecting through ends with the key that was held for a drag, and stays where it was only pressed", () => {
  for (const drags of [true, false]) {
    key("keydown", "t", "KeyT");
    useWorkspace.setState({ through: true }); // what its command does
    if (drags) noteDrag();
    key("keyup", "t", "KeyT");
    expect(useWorkspace.getState().through).toBe(!drags);
  }
});

it("a digit that is held paints no longer once it is let go after a drag", () => {
  key("keydown", "2", "Digit2");
  useWorkspace.setState({ brush: "top" }); // what its command does
  noteDrag();
  key("keyup", "2", "Digit2");
  expect(useWorkspace.getState().brush).toBeNull();
});
