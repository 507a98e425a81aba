// Keys on the grid of cards.
import { beforeEach, describe, expect, it } from "vitest";
import { initialLayout, initialWorkspace, useLayout, useWorkspace } from "../store/workspace";
import { moveByKey } from "./Cards";

const shown = Array.from({ length: 30 }, (_, k) => `a${k}`);
const COLUMNS = 3;

/** Presses a key on an asset; where that leads, and whether the browser is kept from using the key. */
function press(key: string, from: string | null, modifiers = {}): [string | null, boolean] {
  let prevented = false;
  useWorkspace.setState({ asset: from });
  moveByKey({ key, altKey: false, ctrlKey: false, metaKey: false, preventDefault: () => (prevented = true), ...modifiers } as never, shown, COLUMNS);
  return [useWorkspace.getState().asset, prevented];
}

beforeEach(() => {
  useWorkspace.setState(initialWorkspace, true);
  useLayout.setState(initialLayout, true);
});

describe("a key on the cards", () => {
  it.each([
    ["ArrowRight", "a5"],
    ["ArrowLeft", "a3"],
    ["ArrowDown", "a7"],
    ["ArrowUp", "a1"],
    ["PageDown", "a16"],
    ["PageUp", "a0"],
    ["Home", "a0"],
    ["End", "a29"],
  ])("%s goes on from the fifth to %s", (key, to) => {
    expect(press(key, "a4")).toEqual([to, true]);
  });

  it("stays in the list at both ends", () => {
    expect(press("ArrowUp", "a0")[0]).toBe("a0");
    expect(press("ArrowDown", "a29")[0]).toBe("a29");
  });

  it("begins at the first where none is open, or the open one is not shown", () => {
    expect(press("ArrowRight", null)[0]).toBe("a0");
    expect(press("ArrowRight", "hidden")[0]).toBe("a0");
  });

  it("is left to others with a modifier, or where it means nothing", () => {
    expect(press("ArrowRight", "a4", { ctrlKey: true })).toEqual(["a4", false]);
    expect(press("x", "a4")).toEqual(["a4", false]);
  });

  it("Enter opens the view only where the family fills the centre", () => {
    expect(press("Enter", "a4")).toEqual(["a4", false]);
    useLayout.setState({ gallery: true });
    expect(press("Enter", "a4")).toEqual(["a4", true]);
    expect(useLayout.getState().gallery).toBe(false);
  });
});
