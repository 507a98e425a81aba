// The tour goes on by what the person does.
import { beforeEach, expect, test } from "vitest";
import type { Card } from "../wire";
import { initialWorkspace, useWorkspace } from "./workspace";
import { emptyProject, useProject } from "./project";
import { sampleAction, sampleAssessment, sampleCard } from "./sample.test-help";
import { useScenes } from "./scenes";
import { startTour, endTour, followTour, TOUR_STOPS, moveTour, useTour } from "./tour";

const step = () => useTour.getState().step;
const title = () => TOUR_STOPS[step() ?? -1]?.title;
const rule = (number: number) => ({ rule: number, action: sampleAction(), shown: ["a"], nothing: [] });
const rules = (count: number) =>
  useProject.setState(({ project }) => ({ project: { ...project, rules: Array.from({ length: count }, (_, k) => rule(k + 1)) } }));

beforeEach(() => {
  useProject.setState(emptyProject);
  useWorkspace.setState(initialWorkspace);
  useScenes.setState({ scene: null });
  startTour();
});

test("one can go on, back and away at every mark", () => {
  moveTour(-1);
  expect(step()).toBe(0);
  moveTour(1);
  expect(step()).toBe(1);
  endTour();
  expect(step()).toBe(null);
});

test("after the last mark the tour is over", () => {
  TOUR_STOPS.forEach(() => moveTour(1));
  expect(step()).toBe(null);
});

test("doing what a mark asks for goes on by itself", () => {
  const stop = followTour();
  moveTour(1);
  useWorkspace.setState({ stage: "demonstrate" });
  expect(title()).toBe("Select the splinters");
  const hulls = [{ name: "h1", label: "misc" }, { name: "h2", label: "leg" }];
  useScenes.setState({ scene: { hulls } as never });
  useWorkspace.setState({ selection: new Set(["h1", "h2"]) });
  expect(title()).toBe("Select the splinters");
  useWorkspace.setState({ selection: new Set(["h1"]) });
  expect(title()).toBe("Delete them");
  rules(1);
  rules(2);
  expect(title()).toBe("The second table is easier");
  const card: Card = { ...sampleCard(), demonstrated: true };
  useProject.setState({ cards: { a: card, b: card } });
  useWorkspace.setState({ stage: "learn" });
  expect(title()).toBe("MeshForge has learned"); // how sure it is, is not known yet
  useProject.setState({ assessment: sampleAssessment(2, 2) });
  expect(title()).toBe("The first program is not right yet");
  useProject.setState(({ project }) => ({ project: { ...project, answers: [{ kind: "answer", id: "1", text: "", asset: "a" }] } }));
  expect(title()).toBe("Answer until nothing is held");
  useProject.setState({ assessment: sampleAssessment(2, 0, { unseen: 1 }) });
  expect(title()).toBe("Answer until nothing is held");
  useProject.setState({ assessment: sampleAssessment(2, 0) });
  expect(title()).toBe("Write the tables");
  const written: Card = { ...sampleCard(), output: "edited" };
  useProject.setState({ order: ["a", "b"], cards: { a: written, b: { ...written, stale: ["labels"] } } });
  expect(title()).toBe("Write the tables");
  useProject.setState({ cards: { a: written, b: written } });
  expect(title()).toBe("Look, then export");
  stop();
});

test("who did it already is not asked again", () => {
  rules(2);
  useWorkspace.setState({ stage: "demonstrate" });
  moveTour(1);
  expect(title()).toBe("The second table is easier");
});

test("who goes back stays there until Next", () => {
  const stop = followTour();
  useWorkspace.setState({ stage: "demonstrate" });
  moveTour(1);
  moveTour(-1);
  expect(title()).toBe("Four stages");
  useWorkspace.setState({ hover: "x" });
  expect(title()).toBe("Four stages");
  moveTour(1);
  expect(title()).toBe("Select the splinters");
  stop();
});
