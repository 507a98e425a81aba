// Keys that are held during a drag count for it alone; pressed by themselves they switch.
import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { emptyProject, useProject } from "../../store/project";
import { initialWorkspace, useWorkspace } from "../../store/workspace";
import { armHeldDigit, noteDrag, watchHeldKeys } from "./heldKeys";

let listeners: Map<string, (event: unknown) => void>;
let stop: () => void;
const key = (kind: "keydown" | "keyup", pressed: string, code: string) =>
  listeners.get(kind)?.({ key: pressed, code, repeat: false, ctrlKey: false, metaKey: false, altKey: false, shiftKey: false });

beforeEach(() => {
  listeners = new Map();
  vi.stubGlobal("window", { addEventListener: (kind: string, does: (event: unknown) => void) => listeners.set(kind, does) });
  useWorkspace.setState({ ...initialWorkspace, asset: "a" }, true);
  const vocabulary = ["leg", "top"].map((name) => ({ name, text: name, color: "#000000", used: 0, is_class: false }));
  useProject.setState({ ...emptyProject, project: { ...emptyProject.project, vocabulary } }, true);
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

it("a digit that is held paints, also while hulls are selected, and no longer once it is let go", () => {
  key("keydown", "2", "Digit2");
  armHeldDigit();
  expect(useWorkspace.getState().brush).toBe("top");
  noteDrag();
  key("keyup", "2", "Digit2");
  expect(useWorkspace.getState().brush).toBeNull();
});

it("nothing is armed by other keys, nor in other stages", () => {
  key("keydown", "b", "KeyB");
  armHeldDigit();
  useWorkspace.setState({ stage: "review" });
  key("keydown", "1", "Digit1");
  armHeldDigit();
  expect(useWorkspace.getState().brush).toBeNull();
});
