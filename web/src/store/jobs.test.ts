import { beforeEach, expect, it, vi } from "vitest";
import { commandFor } from "../commands/all";
import { labelling } from "../commands/labelling";
import { api } from "../server/api";
import type { Job } from "../wire";
import { initialDesk, useDesk } from "./desk";
import { notCarriable } from "./jobs";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { useToasts } from "./toasts";

const job: Job = { id: "p", kind: "propagate", title: "", done: 0, total: 2, state: "running", message: "", lines: [], out: null };
const whole = sampleCard({ asset: "a", hulls: 2, labels: [0, 0], given: 2 });
const bare = sampleCard({ asset: "b", hulls: 2, labels: [-1, -1] });
const vocabulary = [{ name: "leg", color: "#000000", used: 2 }];
const project = { ...emptyProject.project, vocabulary };

beforeEach(() => {
  useProject.setState({ ...emptyProject, project, order: ["a", "b"], cards: { a: whole, b: bare } }, true);
  useDesk.setState(initialDesk, true);
  useToasts.setState({ toasts: [] });
});

it("says why labels cannot be carried over", () => {
  expect(notCarriable()).toBeNull();
  useProject.setState({ jobs: [job] });
  expect(notCarriable()).toContain("now");
  useProject.setState({ jobs: [{ ...job, state: "done" }], cards: { a: whole } });
  expect(notCarriable()).toContain("Every hull");
  useProject.setState({ cards: { a: { ...whole, given: 0 } } });
  expect(notCarriable()).toContain("one asset first");
  useProject.setState({ project: emptyProject.project });
  expect(notCarriable()).toContain("called");
  useProject.setState({ order: [] });
  expect(notCarriable()).toContain("no assets");
});

it("is one key in the stage of labels, which tells where it cannot be done", async () => {
  const begun = vi.spyOn(api, "startJob").mockResolvedValue(job);
  await commandFor("P", labelling)?.run();
  expect(begun).toHaveBeenCalledWith({ kind: "propagate" });
  useProject.setState({ project: emptyProject.project });
  await commandFor("P", labelling)?.run();
  expect(begun).toHaveBeenCalledTimes(1);
  expect(useToasts.getState().toasts.map(({ text }) => text)).toEqual(["Say first what the parts are called."]);
  useDesk.setState({ stage: "review" });
  expect(commandFor("P", labelling)).toBeUndefined();
});
