// Which keys are commands, and which are left to the element that has the focus.
import { beforeEach, describe, expect, it, vi } from "vitest";
import { useScenes } from "../store/scenes";
import { initialWorkspace, useWorkspace } from "../store/workspace";
import { bindKeys } from "./keys";

/** An element that fits some selectors; it stands for what is pressed on. */
class FakeElement {
  constructor(private readonly fits: readonly string[] = []) {}
  closest(selector: string): this | null {
    return this.matches(selector) ? this : null;
  }
  matches(selector: string): boolean {
    return this.fits.some((one) => selector.includes(one));
  }
}

interface Press {
  key: string;
  code?: string;
  on?: FakeElement;
  repeat?: boolean;
  shiftKey?: boolean;
  ctrlKey?: boolean;
  isComposing?: boolean;
}

const body = new FakeElement();
const field = new FakeElement(["textarea"]);
const button = new FakeElement(["[role=slider]"]);
const hulls = new FakeElement(["[role=grid]"]);
const family = new FakeElement(["[role=listbox]"]);
const dialog = new FakeElement(["[role=dialog]"]);

let listeners: Map<string, (event: unknown) => void>;

function press({ key, code = `Key${key.toUpperCase()}`, on = body, ...rest }: Press): boolean {
  let prevented = false;
  const event = { key, code, target: on, repeat: false, shiftKey: false, ctrlKey: false, altKey: false, metaKey: false, isComposing: false, defaultPrevented: false, preventDefault: () => (prevented = true), ...rest };
  listeners.get("keydown")?.(event);
  return prevented;
}

const wireframe = () => useWorkspace.getState().view.wireframe;

beforeEach(() => {
  listeners = new Map();
  vi.stubGlobal("Element", FakeElement);
  vi.stubGlobal("document", { body, querySelectorAll: () => [] });
  vi.stubGlobal("window", { addEventListener: (kind: string, does: (event: unknown) => void) => listeners.set(kind, does) });
  useWorkspace.setState({ ...initialWorkspace, asset: "a", stage: "demonstrate" }, true);
  useScenes.setState({ scene: { asset: "a", hulls: [{ name: "x" }], contacts: [], edit: null, view: { steps: [] } } as never });
  bindKeys();
});

describe("a key", () => {
  it("does what its command does, and nothing else", () => {
    expect(press({ key: "z" })).toBe(true);
    expect(wireframe()).toBe(true);
  });

  it("without a command is left to the browser", () => {
    expect(press({ key: "u" })).toBe(false);
  });

  it("in a field is typed, but for the few that leave it", () => {
    expect(press({ key: "z", on: field })).toBe(false);
    expect(wireframe()).toBe(false);
    useWorkspace.setState({ selection: new Set(["x"]) });
    expect(press({ key: "Escape", code: "Escape", on: field })).toBe(true);
    expect(useWorkspace.getState().selection.size).toBe(0);
  });

  it("belongs to a dialog or an overlay that is open", () => {
    expect(press({ key: "z", on: dialog })).toBe(false);
    useWorkspace.setState({ overlay: "help" });
    expect(press({ key: "z" })).toBe(false);
    expect(wireframe()).toBe(false);
  });

  it("that composes a letter is no command", () => {
    expect(press({ key: "z", isComposing: true })).toBe(false);
  });

  it("that is held does its command once, but for those that go on", () => {
    press({ key: "z" });
    expect(press({ key: "z", repeat: true })).toBe(true);
    expect(wireframe()).toBe(true);
  });
});

describe("a control that a key brought the focus to", () => {
  beforeEach(() => {
    press({ key: "ArrowDown", code: "ArrowDown", on: button });
    useWorkspace.setState({ draft: { name: "Delete", arguments: {}, each: false, label: null, editing: null } });
  });

  it("has Enter for itself", () => {
    expect(press({ key: "Enter", code: "Enter", on: button })).toBe(false);
  });

  it("leaves it to the action in hand where it is the list of hulls, which Enter means nothing to", () => {
    expect(press({ key: "Enter", code: "Enter", on: hulls })).toBe(true);
    expect(press({ key: " ", code: "Space", on: hulls })).toBe(false);
  });

  it("has it no longer after a click: then Enter is for the action in hand", () => {
    listeners.get("pointerdown")?.({});
    expect(press({ key: "Enter", code: "Enter", on: button })).toBe(true);
  });

  it("leaves the letters to the commands", () => {
    expect(press({ key: "z", on: button })).toBe(true);
  });
});

describe("Tab", () => {
  const assets = async () => {
    const { emptyProject, useProject } = await import("../store/project");
    const { sampleCard } = await import("../store/sample.test-help");
    const cards = { a: sampleCard({ asset: "a" }), b: sampleCard({ asset: "b" }) };
    useProject.setState({ ...emptyProject, cards, order: ["a", "b"] }, true);
  };

  it("goes to the next asset while the pointer is in use, also from the family", async () => {
    await assets();
    expect(press({ key: "Tab", code: "Tab" })).toBe(true);
    expect(useWorkspace.getState().asset).toBe("b");
    expect(press({ key: "Tab", code: "Tab", on: family })).toBe(true);
    expect(useWorkspace.getState().asset).toBe("a");
  });

  it("leaves the family once a key brought one there, in which arrows move", async () => {
    await assets();
    press({ key: "Tab", code: "Tab", on: button });
    press({ key: "ArrowDown", code: "ArrowDown", on: family });
    const { asset } = useWorkspace.getState();
    for (const shiftKey of [false, true]) expect(press({ key: "Tab", code: "Tab", on: family, shiftKey })).toBe(false);
    expect(useWorkspace.getState().asset).toBe(asset);
  });

  it("moves the focus on as everywhere once keys moved it", async () => {
    await assets();
    press({ key: "ArrowDown", code: "ArrowDown", on: button });
    expect(press({ key: "Tab", code: "Tab", on: button })).toBe(false);
    expect(useWorkspace.getState().asset).toBe("a");
  });
});

describe("F6", () => {
  const part = (name: string, focused: string[]) => {
    const first = { focus: () => focused.push(name), offsetParent: {} };
    const part = {
      contains: (element: unknown) => element === name,
      querySelectorAll: (selector: string) => (selector === "[data-first]" ? [] : [{ ...first, closest: () => part }]),
    };
    return part;
  };

  it("moves the focus from part to part, round the end, also out of a field", () => {
    const focused: string[] = [];
    const parts = ["top", "view", "panel"].map((name) => part(name, focused));
    const document = { body, activeElement: "view", querySelectorAll: () => parts };
    vi.stubGlobal("document", document);
    expect(press({ key: "F6", code: "F6", on: field })).toBe(true);
    document.activeElement = "panel";
    press({ key: "F6", code: "F6" });
    press({ key: "F6", code: "F6", shiftKey: true });
    document.activeElement = "nowhere";
    press({ key: "F6", code: "F6" });
    press({ key: "F6", code: "F6", shiftKey: true });
    expect(focused).toEqual(["panel", "top", "view", "top", "panel"]);
  });

  it("leads to a part that has another within it, and from there to that one", () => {
    const focused: string[] = [];
    const inner = { contains: (element: unknown) => element === "row", querySelectorAll: () => [row] };
    const row = { focus: () => focused.push("row"), offsetParent: {}, closest: () => inner };
    const tab = { focus: () => focused.push("tab"), offsetParent: {}, closest: (): unknown => outer };
    const outer = {
      contains: (element: unknown) => element === "tab" || element === "row",
      querySelectorAll: (selector: string) => (selector === "[data-first]" ? [row] : [tab, row]),
    };
    const document = { body, activeElement: "nowhere", querySelectorAll: () => [outer, inner] };
    vi.stubGlobal("document", document);
    press({ key: "F6", code: "F6" });
    document.activeElement = "tab";
    press({ key: "F6", code: "F6" });
    document.activeElement = "row";
    press({ key: "F6", code: "F6", shiftKey: true });
    expect(focused).toEqual(["tab", "row", "tab"]);
  });
});
