// What is written to the browser, when, and the theme of the page.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";

/** The modules as a page has them that was just loaded. */
async function load() {
  vi.resetModules();
  const [preferences, workspace] = await Promise.all([import("./preferences"), import("../store/workspace")]);
  return { ...preferences, ...workspace };
}

const KEY = "meshforge.desk";
let kept: Map<string, string>;
let writes: number;
let leave: () => void;

const stored = () => JSON.parse(kept.get(KEY) ?? "null") as { view: { wireframe: boolean }; layout: { family: boolean } } | null;

beforeEach(() => {
  vi.useFakeTimers();
  kept = new Map();
  writes = 0;
  const setItem = (key: string, value: string) => {
    writes += 1;
    kept.set(key, value);
  };
  vi.stubGlobal("localStorage", { getItem: (key: string) => kept.get(key) ?? null, setItem });
  vi.stubGlobal("window", { addEventListener: (_kind: string, does: () => void) => (leave = does) });
});

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("settings", () => {
  it("that were kept are there again", async () => {
    const { keepPreferences, useLayout, useWorkspace } = await load();
    kept.set(KEY, JSON.stringify({ theme: "dark", sort: "hulls", view: { wireframe: true }, layout: { family: false } }));
    keepPreferences();
    const { theme, view, filters } = useWorkspace.getState();
    expect([theme, view.wireframe, view.grid, filters.sort, useLayout.getState().family]).toEqual(["dark", true, true, "hulls", false]);
  });

  it("that cannot be read are as at first", async () => {
    const { initialWorkspace, keepPreferences, useWorkspace } = await load();
    kept.set(KEY, "{broken");
    keepPreferences();
    expect(useWorkspace.getState()).toEqual(initialWorkspace);
  });

  it("are written a moment after a change, several at once", async () => {
    const { keepPreferences, setLayout, setView } = await load();
    keepPreferences();
    setView({ wireframe: true });
    setLayout({ family: false });
    expect(writes).toBe(0);
    vi.advanceTimersByTime(300);
    expect(writes).toBe(1);
    expect([stored()?.view.wireframe, stored()?.layout.family]).toEqual([true, false]);
  });

  it("are not written for what is not kept", async () => {
    const { keepPreferences, setView, useWorkspace } = await load();
    keepPreferences();
    setView({ wireframe: true });
    vi.advanceTimersByTime(300);
    useWorkspace.setState({ hover: "x", asset: "a" });
    setView({ explode: 1 });
    vi.advanceTimersByTime(300);
    expect(writes).toBe(1);
  });

  it("are written at once when the person leaves", async () => {
    const { keepPreferences, setView } = await load();
    keepPreferences();
    setView({ wireframe: true });
    leave();
    expect(stored()?.view.wireframe).toBe(true);
  });
});

describe("the theme of the page", () => {
  const dataset: { theme?: string } = {};
  let dark: { matches: boolean };
  let change: () => void;
  let page: Awaited<ReturnType<typeof load>>;

  beforeEach(async () => {
    dark = { matches: false };
    const media = { get matches() { return dark.matches; }, addEventListener: (_kind: string, does: () => void) => (change = does) };
    vi.stubGlobal("window", { matchMedia: () => media });
    vi.stubGlobal("document", { documentElement: { dataset } });
    page = await load();
    page.followTheme();
  });

  it("is that of the system, also when the system changes", () => {
    expect(dataset.theme).toBe("light");
    dark.matches = true;
    change();
    expect(dataset.theme).toBe("dark");
  });

  it("is the one that the person chose, whatever the system has", () => {
    page.useWorkspace.setState({ theme: "dark" });
    expect(dataset.theme).toBe("dark");
    change();
    expect(dataset.theme).toBe("dark");
    page.useWorkspace.setState({ theme: "light" });
    expect(dataset.theme).toBe("light");
  });
});
