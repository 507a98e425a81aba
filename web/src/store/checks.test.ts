import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { commandFor } from "../commands/all";
import { reviewing } from "../commands/reviewing";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import type { Checked, Job } from "../wire";
import { again, measure, type Part, PARTS, partKey, PASSING, selectInOutput, showPictures, useChecks } from "./checks";
import { initialDesk, openStage, useDesk } from "./desk";
import { notCheckable } from "./jobs";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";

const checked = (part: Part): Checked => ({ part, figures: [], findings: [], gone: 0, notes: [], cell: null, pictured: false });
const problem = { message: "the process that worked on this died", where: null, remedy: null, conflict: false };
const kinds = () => PARTS.map((part) => useChecks.getState().parts[partKey("a", "1", part)]?.kind);

beforeEach(() => {
  vi.useFakeTimers();
  useChecks.setState({ parts: {}, tries: 0, pictured: [] });
  useDesk.setState(initialDesk, true);
  useProject.setState(emptyProject, true);
});
afterEach(() => {
  vi.useRealTimers();
  vi.restoreAllMocks();
});

it("measures nothing of what one only passes by", async () => {
  const asked = vi.spyOn(api, "checked");
  measure("a", "1")();
  await vi.advanceTimersByTimeAsync(PASSING * 2);
  expect(asked).not.toHaveBeenCalled();
});

it("measures one part after the other, each once", async () => {
  const asked = vi.spyOn(api, "checked").mockImplementation((_, part) => Promise.resolve(checked(part)));
  const stop = measure("a", "1");
  await vi.advanceTimersByTimeAsync(PASSING);
  stop();
  expect(asked.mock.calls.map(([, part]) => part)).toEqual(PARTS);
  expect(kinds()).toEqual(PARTS.map(() => "there"));
  measure("a", "1");
  await vi.advanceTimersByTimeAsync(PASSING);
  expect(asked).toHaveBeenCalledTimes(PARTS.length);
  measure("a", "2");
  await vi.advanceTimersByTimeAsync(PASSING);
  expect(asked).toHaveBeenCalledTimes(2 * PARTS.length);
});

it("stops when one goes on, and begins again where it stopped", async () => {
  vi.spyOn(api, "checked").mockImplementation((_, part, stop) =>
    part === "physics"
      ? new Promise((_, refuse) => stop.addEventListener("abort", () => refuse(new DOMException("", "AbortError"))))
      : Promise.resolve(checked(part)),
  );
  const stop = measure("a", "1");
  await vi.advanceTimersByTimeAsync(PASSING);
  expect(kinds()).toEqual(["there", "coming", undefined, undefined]);
  stop();
  await vi.advanceTimersByTimeAsync(PASSING);
  expect(kinds()).toEqual(["there", undefined, undefined, undefined]);
});

it("says what could not be measured, goes on with the rest, and tries again when asked to", async () => {
  const asked = vi.spyOn(api, "checked").mockImplementation((_, part) =>
    part === "physics" ? Promise.reject(new ServerProblem(problem, 400)) : Promise.resolve(checked(part)),
  );
  measure("a", "1");
  await vi.advanceTimersByTimeAsync(PASSING);
  expect(kinds()).toEqual(["there", "problem", "there", "there"]);
  asked.mockImplementation((_, part) => Promise.resolve(checked(part)));
  again("a", "1", "physics");
  expect(useChecks.getState().tries).toBe(1);
  measure("a", "1");
  await vi.advanceTimersByTimeAsync(PASSING);
  expect(kinds()).toEqual(PARTS.map(() => "there"));
});

it("shows the output where hulls of it are selected", () => {
  useDesk.setState({ asset: "a", stage: "review", showing: { kind: "result", of: "program" } });
  selectInOutput("a", ["h"]);
  expect(useDesk.getState().showing).toEqual({ kind: "result", of: "output" });
  expect([...useDesk.getState().selection]).toEqual(["h"]);
});

it("keeps for each part whether its pictures are shown", () => {
  showPictures("fit", true);
  showPictures("fit", true);
  showPictures("clearance", true);
  showPictures("fit", false);
  expect(useChecks.getState().pictured).toEqual(["clearance"]);
});

it("has a key in the review, and says why results cannot be checked", () => {
  expect(commandFor("Shift+C", reviewing)).toBeUndefined();
  openStage("review");
  commandFor("Shift+C", reviewing)?.run();
  expect(useDesk.getState().checks.open).toBe(true);
  expect(notCheckable()).toContain("apply");
  useProject.setState({ cards: { a: sampleCard({ check: "c" }) } });
  expect(notCheckable()).toBeNull();
  useProject.setState({ jobs: [{ kind: "check", state: "running" } as Job] });
  expect(notCheckable()).toContain("now");
});
