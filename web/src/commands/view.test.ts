// Keys that look.
import { beforeEach, describe, expect, it } from "vitest";
import { useScenes } from "../store/scenes";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import { commandFor } from "./list";
import { viewCommands } from "./view";

const press = (key: string) => commandFor(key, viewCommands)?.run();
const order = () => useWorkspace.getState().cameraOrder;
const view = () => useWorkspace.getState().view;
const run = (id: string) => {
  const command = viewCommands.find((one) => one.id === id);
  if (command?.enabled?.() ?? true) command?.run();
};

beforeEach(() => {
  useWorkspace.setState({ ...initialWorkspace, asset: "a", stage: "demonstrate" }, true);
  useScenes.setState({ scene: { asset: "a", hulls: [], edit: null } as never });
});

describe("keys that move the camera", () => {
  it.each([
    ["Numpad1", "front"],
    ["Ctrl+Numpad1", "back"],
    ["Numpad3", "right"],
    ["Ctrl+Numpad3", "left"],
    ["Numpad7", "top"],
    ["Ctrl+Numpad7", "bottom"],
    ["Numpad0", "iso"],
    ["Home", "fit"],
    [".", "frame"],
    ["NumpadDecimal", "frame"],
  ])("%s looks from: %s", (key, to) => {
    press(key);
    expect(order()).toEqual({ count: 1, to });
  });

  it("are an order of their own each time, also to the same side", () => {
    press("Numpad7");
    press("Numpad7");
    expect(order()).toEqual({ count: 2, to: "top" });
  });

  it("are the digits, too, but while hulls are labelled with them", () => {
    press("7");
    expect(order().to).toBe("top");
    useWorkspace.setState({ stage: "label" });
    expect(commandFor("7", viewCommands)).toBeUndefined();
    expect(commandFor("Numpad7", viewCommands)).toBeDefined();
  });

  it("mean nothing while nothing is shown", () => {
    useScenes.setState({ scene: null });
    expect(commandFor("Home", viewCommands)).toBeUndefined();
    expect(commandFor("Numpad1", viewCommands)).toBeUndefined();
  });

  it("switch between perspective and parallel projection", () => {
    press("O");
    expect(view().projection).toBe("orthographic");
    press("O");
    expect(view().projection).toBe("perspective");
  });
});

describe("keys that switch what is drawn", () => {
  it.each([
    ["Z", "wireframe"],
    ["V", "ghost"],
    ["C", "contacts"],
  ] as const)("%s switches on and off: %s", (key, what) => {
    press(key);
    expect(view()[what]).toBe(true);
    press(key);
    expect(view()[what]).toBe(false);
  });

  it("change one setting and leave the others", () => {
    press("Z");
    expect(view()).toEqual({ ...initialWorkspace.view, wireframe: true });
  });
});

describe("tools", () => {
  it("are taken by a key, and left by it again", () => {
    press("B");
    expect(useWorkspace.getState().tool).toBe("box");
    press("L");
    expect(useWorkspace.getState().tool).toBe("lasso");
    press("L");
    expect(useWorkspace.getState().tool).toBe("select");
  });

  it("are left by Escape, which means nothing here without one", () => {
    expect(commandFor("Escape", viewCommands)).toBeUndefined();
    press("B");
    press("Escape");
    expect(useWorkspace.getState().tool).toBe("select");
  });
});

describe("before and after", () => {
  it("can be compared only where something was edited", () => {
    run("compare-slider");
    expect(view().compare).toBe("off");
    useScenes.setState({ scene: { asset: "a", hulls: [], edit: { made: [], removed: [] } } as never });
    run("compare-slider");
    expect(view().compare).toBe("slider");
  });

  it("are in one way at a time, and in none after the second time", () => {
    useScenes.setState({ scene: { asset: "a", hulls: [], edit: { made: [], removed: [] } } as never });
    run("compare-slider");
    run("compare-side");
    expect(view().compare).toBe("side");
    run("compare-side");
    expect(view().compare).toBe("off");
  });
});
