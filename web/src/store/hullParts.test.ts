// The parts of a hull that a person is asked about: where they are shown, and until when.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { api } from "../server/api";
import { countSpans, dividedHull, groupParts, showHullParts, spansOf, useHullParts } from "./hullParts";
import { sampleCard } from "./sample.test-help";
import type { Scene } from "./scene";
import { useToasts } from "./toasts";

const packet = { header: { rows: [], hull: "base", parts: [] }, rows: [], shapes: [] };
const scene = (more: object = {}) =>
  ({ asset: "cup", showing: { kind: "source" }, hulls: [{ name: "base" }, { name: "rim" }], ...more }) as unknown as Scene;
const shown = () => useHullParts.getState().shown;

beforeEach(() => useHullParts.setState({ shown: null }));
afterEach(() => vi.restoreAllMocks());

describe("the parts of a hull", () => {
  it("are shown until the question is over", async () => {
    const fetched = vi.spyOn(api, "parts").mockResolvedValue(packet);
    const stop = showHullParts("cup", "base");
    expect(fetched).toHaveBeenCalledWith("cup", "base");
    await vi.waitFor(() => expect(shown()).toEqual({ asset: "cup", packet }));
    expect(dividedHull(scene())?.name).toBe("base");
    stop();
    expect(shown()).toBeNull();
    expect(dividedHull(scene())).toBeNull();
  });

  it("are not shown where they come after it", async () => {
    vi.spyOn(api, "parts").mockResolvedValue(packet);
    showHullParts("cup", "base")();
    await Promise.resolve();
    expect(shown()).toBeNull();
  });

  it("that cannot be had are reported", async () => {
    useToasts.setState({ toasts: [] });
    vi.spyOn(api, "parts").mockRejectedValue(new Error("gone"));
    vi.spyOn(console, "error").mockReturnValue();
    showHullParts("cup", "base");
    await vi.waitFor(() => expect(useToasts.getState().toasts).toHaveLength(1));
    expect(shown()).toBeNull();
  });

  it("are told by their labels", () => {
    const part = (label: string, confidence: number) => ({ label, confidence });
    expect(groupParts([part("wall", 0.92), part("handle", 0.93), part("wall", 0.754), part("wall", 0.92)])).toEqual([
      { label: "wall", count: 3, share: "75% to 92%" },
      { label: "handle", count: 1, share: "93%" },
    ]);
  });

  it("are on their asset as it comes, and nowhere else", () => {
    useHullParts.setState({ shown: { asset: "cup", packet } });
    expect(dividedHull(scene({ asset: "mug" }))).toBeNull();
    expect(dividedHull(scene({ showing: { kind: "result", of: "program" } }))).toBeNull();
    expect(dividedHull(scene({ parts: [] }))).toBeNull();
    expect(dividedHull(scene({ hulls: [{ name: "base#0" }] }))).toBeNull();
  });
});

describe("hulls that likely span parts", () => {
  const cards = { cup: sampleCard({ asset: "cup", spans: { base: "base holds wall and base, 87%" } }), mug: sampleCard({ asset: "mug" }) };

  it("are named on their asset, also among steps, and not on results or several assets", () => {
    expect(spansOf(scene(), cards)).toEqual({ base: "base holds wall and base, 87%" });
    expect(spansOf(scene({ showing: { kind: "steps", steps: 0 } }), cards)).toHaveProperty("base");
    expect(spansOf(scene({ showing: { kind: "result", of: "program" } }), cards)).toEqual({});
    expect(spansOf(scene({ parts: [] }), cards)).toEqual({});
    expect(spansOf(scene({ asset: "gone" }), cards)).toEqual({});
  });

  it("are counted over the family", () => {
    expect(countSpans(cards)).toBe(1);
  });
});
