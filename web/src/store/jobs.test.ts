import { beforeEach, expect, it, vi } from "vitest";
import { commandFor } from "../commands/list";
import { labelCommands } from "../commands/label";
import { api } from "../server/api";
import type { Job } from "../wire";
import { initialWorkspace, useWorkspace } from "./workspace";
import { labelAll, whyNotLabel } from "./jobs";
import { paint } from "./labels";
import { useLabelSources } from "./labelSources";
import { emptyProject, useProject } from "./project";
import { useScenes } from "./scenes";
import { sampleCard } from "./sample.test-help";
import { useToasts } from "./toasts";

const job: Job = { id: "p", kind: "label", title: "", done: 0, total: 2, doing: "", left: null, state: "running", message: "", lines: [], out: null };
const whole = sampleCard({ asset: "a", hulls: 2, labels: [0, 0], confidence: [101, 101] });
const bare = sampleCard({ asset: "b", hulls: 2, labels: [-1, -1], confidence: [-1, -1] });
const vocabulary = [{ name: "leg", text: "leg", color: "#000000", used: 2, is_class: false }];
const project = { ...emptyProject.project, vocabulary };

beforeEach(() => {
  useProject.setState({ ...emptyProject, project, order: ["a", "b"], cards: { a: whole, b: bare } }, true);
  useWorkspace.setState(initialWorkspace, true);
  useLabelSources.setState({ files: 0, names: 0 });
  useToasts.setState({ toasts: [] });
});

it("says why hulls cannot be labelled", () => {
  expect(whyNotLabel()).toBeNull();
  useProject.setState({ jobs: [job] });
  expect(whyNotLabel()).toContain("now");
  useProject.setState({ jobs: [{ ...job, state: "done" }], cards: { a: whole } });
  expect(whyNotLabel()).toContain("Every label was given");
  useProject.setState({ cards: { a: bare } });
  expect(whyNotLabel()).toContain("one asset first");
  useProject.setState({ project: emptyProject.project });
  expect(whyNotLabel()).toContain("names of the labels");
  useLabelSources.setState({ files: 1 });
  expect(whyNotLabel()).toBeNull();
  useProject.setState({ order: [] });
  expect(whyNotLabel()).toContain("no assets");
});

it("is one key in the stage of labels, which says where it cannot be done", async () => {
  const begun = vi.spyOn(api, "startJob").mockResolvedValue(job);
  await commandFor("P", labelCommands)?.run();
  expect(begun).toHaveBeenCalledWith({ kind: "label" });
  useProject.setState({ project: emptyProject.project });
  await commandFor("P", labelCommands)?.run();
  expect(begun).toHaveBeenCalledTimes(1);
  expect(useToasts.getState().toasts.map(({ text }) => text)).toEqual(["Type the names of the labels first."]);
  useWorkspace.setState({ stage: "review" });
  await commandFor("P", labelCommands)?.run();
  expect(useToasts.getState().toasts.at(-1)?.text).toBe("P labels all hulls in the Label stage (Alt+1).");
});

it.each([true, false])("labels all hulls only when what was painted before is saved, and not where that is refused", async (saved) => {
  const asked: string[] = [];
  let save = (): void => undefined;
  vi.spyOn(api, "startJob").mockImplementation(async () => (asked.push("job"), job));
  vi.spyOn(api, "edit").mockImplementation(async () => {
    await new Promise<void>((pass) => (save = pass));
    asked.push("edit");
    if (!saved) throw new Error("no");
    return { message: "", nothing: true };
  });
  useWorkspace.setState({ asset: "b", brush: "leg" });
  useScenes.setState({ scene: { asset: "b", hulls: [{ name: "x" }], view: { hulls: [{ name: "x" }] } } as never });
  paint(["x"]);
  const begun = labelAll();
  await vi.waitFor(() => expect(api.edit).toHaveBeenCalled());
  expect(asked).toEqual([]);
  save();
  expect(await begun).toBe(saved);
  expect(asked).toEqual(saved ? ["edit", "job"] : ["edit"]);
});
