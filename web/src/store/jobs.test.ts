import { beforeEach, expect, it, vi } from "vitest";
import { commandFor } from "../commands/list";
import { labelCommands } from "../commands/label";
import { api } from "../server/api";
import type { Job } from "../wire";
import { initialWorkspace, useWorkspace } from "./workspace";
import { whyNotPropagate } from "./jobs";
import { emptyProject, useProject } from "./project";
import { sampleCard } from "./sample.test-help";
import { useToasts } from "./toasts";

const job: Job = { id: "p", kind: "propagate", title: "", done: 0, total: 2, doing: "", state: "running", message: "", lines: [], out: null };
const whole = sampleCard({ asset: "a", hulls: 2, labels: [0, 0], given: 2 });
const bare = sampleCard({ asset: "b", hulls: 2, labels: [-1, -1] });
const vocabulary = [{ name: "leg", text: "leg", color: "#000000", used: 2, is_class: false }];
const project = { ...emptyProject.project, vocabulary };

beforeEach(() => {
  useProject.setState({ ...emptyProject, project, order: ["a", "b"], cards: { a: whole, b: bare } }, true);
  useWorkspace.setState(initialWorkspace, true);
  useToasts.setState({ toasts: [] });
});

it("says why labels cannot be propagated", () => {
  expect(whyNotPropagate()).toBeNull();
  useProject.setState({ jobs: [job] });
  expect(whyNotPropagate()).toContain("now");
  useProject.setState({ jobs: [{ ...job, state: "done" }], cards: { a: whole } });
  expect(whyNotPropagate()).toContain("labelled every hull");
  useProject.setState({ cards: { a: { ...whole, given: 0 } } });
  expect(whyNotPropagate()).toContain("one asset first");
  useProject.setState({ project: emptyProject.project });
  expect(whyNotPropagate()).toContain("names of the labels");
  useProject.setState({ order: [] });
  expect(whyNotPropagate()).toContain("no assets");
});

it("is one key in the stage of labels, which says where it cannot be done", async () => {
  const begun = vi.spyOn(api, "startJob").mockResolvedValue(job);
  await commandFor("P", labelCommands)?.run();
  expect(begun).toHaveBeenCalledWith({ kind: "propagate" });
  useProject.setState({ project: emptyProject.project });
  await commandFor("P", labelCommands)?.run();
  expect(begun).toHaveBeenCalledTimes(1);
  expect(useToasts.getState().toasts.map(({ text }) => text)).toEqual(["Type the names of the labels first."]);
  useWorkspace.setState({ stage: "review" });
  await commandFor("P", labelCommands)?.run();
  expect(useToasts.getState().toasts.at(-1)?.text).toBe("P propagates labels in the Label stage (Alt+1).");
});
