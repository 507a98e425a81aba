import { describe, expect, it } from "vitest";
import type { Card, Hello } from "../wire";
import { emptyProject, applyEvent, receive, useProject } from "./project";
import { sampleCard } from "./sample.test-help";

const card = (asset: string, more: Partial<Card> = {}) => sampleCard({ asset, picture: "p", ...more });

const hello: Hello = {
  kind: "hello",
  version: "1",
  project: emptyProject.project,
  cards: [card("b"), card("a")],
  history: emptyProject.history,
  program: emptyProject.program,
  outcome: null,
  learning: false,
  reach: [],
  assessment: null,
  assessing: false,
  jobs: [],
  tour: false,
  leave: false,
  engines: {},
  merged_files: [],
  merged_by: [],
  language: emptyProject.language,
};
const begun = applyEvent(emptyProject, hello);

describe("what the server says", () => {
  it("keeps the order that the server gives", () => {
    expect(begun.order).toEqual(["b", "a"]);
    expect(begun.ready).toBe(true);
  });

  it("changes only the cards that are sent", () => {
    const after = applyEvent(begun, { kind: "cards", cards: [card("a", { demonstrated: true })], gone: [] });
    expect(after.cards["a"]?.demonstrated).toBe(true);
    expect(after.cards["b"]).toBe(begun.cards["b"]);
    expect(after.order).toBe(begun.order);
  });

  it("takes new assets in by name, and forgets those that are gone", () => {
    const after = applyEvent(begun, { kind: "cards", cards: [card("c")], gone: ["b"] });
    expect(after.order).toEqual(["a", "c"]);
    expect(Object.keys(after.cards).sort()).toEqual(["a", "c"]);
  });

  it("counts the revisions of assets that changed, shapes only where they did", () => {
    const after = applyEvent(begun, { kind: "assets", assets: ["a"], shapes: false });
    expect(after.revisions["a"]).toBe((begun.revisions["a"] ?? 0) + 1);
    expect(after.shapeRevisions["a"]).toBe(begun.shapeRevisions["a"]);
    expect(applyEvent(after, { kind: "assets", assets: ["a"], shapes: true }).shapeRevisions["a"]).toBe(2);
  });

  it("is passed over where it is of a kind that only a newer server knows", () => {
    expect(applyEvent(begun, { kind: "weather", rain: true } as never)).toBe(begun);
    receive(hello);
    const before = useProject.getState();
    receive({ kind: "weather", rain: true } as never);
    expect(useProject.getState()).toBe(before);
  });

  it("takes everything for changed after a new connection", () => {
    const again = applyEvent(begun, hello);
    expect(again.revisions["a"]).toBe(2);
    expect(again.shapeRevisions["b"]).toBe(2);
  });

  it("keeps the last outcome while the next one is learned", () => {
    const outcome = { number: 1, status: "found" } as never;
    const learned = applyEvent(begun, { kind: "outcome", outcome, learning: false });
    const busy = applyEvent(learned, { kind: "outcome", outcome: null, learning: true });
    expect(busy.learning).toBe(true);
    expect(busy.outcome).toBe(outcome);
    expect(applyEvent(busy, { kind: "outcome", outcome: null, learning: false }).outcome).toBeNull();
  });

  it("has each job once, as it stands", () => {
    const job = { id: "1", kind: "apply", title: "", done: 0, total: 2, doing: "", state: "running", message: "", lines: [], out: null };
    const one = applyEvent(begun, { kind: "job", job: job as never });
    const two = applyEvent(one, { kind: "job", job: { ...job, done: 1 } as never });
    expect(two.jobs).toHaveLength(1);
    expect(two.jobs[0]?.done).toBe(1);
  });
});
