// The tour goes on by what the person does.
import { beforeEach, expect, test } from "vitest";
import type { Card } from "../wire";
import { initialDesk, useDesk } from "./desk";
import { emptyProject, useProject } from "./project";
import { useScenes } from "./scenes";
import { beginTour, endTour, followTour, MARKS, turnTour, useTour } from "./tour";

const step = () => useTour.getState().step;
const title = () => MARKS[step() ?? -1]?.title;
const rule = (number: number) => ({ rule: number, action: "Delete", shown: ["a"], nothing: [] });
const rules = (count: number) =>
  useProject.setState(({ project }) => ({ project: { ...project, rules: Array.from({ length: count }, (_, k) => rule(k + 1)) } }));

beforeEach(() => {
  useProject.setState(emptyProject);
  useDesk.setState(initialDesk);
  useScenes.setState({ scene: null });
  beginTour();
});

test("one can go on, back and away at every mark", () => {
  turnTour(-1);
  expect(step()).toBe(0);
  turnTour(1);
  expect(step()).toBe(1);
  endTour();
  expect(step()).toBe(null);
});

test("after the last mark the tour is over", () => {
  MARKS.forEach(() => turnTour(1));
  expect(step()).toBe(null);
});

test("doing what a mark asks for goes on by itself", () => {
  const stop = followTour();
  turnTour(1);
  useDesk.setState({ stage: "demonstrate" });
  expect(title()).toBe("Pick the splinters");
  const hulls = [{ name: "h1", label: "misc" }, { name: "h2", label: "leg" }];
  useScenes.setState({ scene: { hulls } as never });
  useDesk.setState({ selection: new Set(["h1", "h2"]) });
  expect(title()).toBe("Pick the splinters");
  useDesk.setState({ selection: new Set(["h1"]) });
  expect(title()).toBe("Delete them");
  rules(1);
  rules(2);
  expect(title()).toBe("The second table is easier");
  const card = { demonstrated: true, output: "none" } as Card;
  useProject.setState({ cards: { a: card, b: card } });
  useDesk.setState({ stage: "learn" });
  useDesk.setState({ stage: "review" });
  expect(title()).toBe("Do it to all");
  useProject.setState({ cards: { a: { ...card, output: "edited" } } });
  expect(title()).toBe("That is all");
  stop();
});

test("who did it already is not asked again", () => {
  rules(2);
  useDesk.setState({ stage: "demonstrate" });
  turnTour(1);
  expect(title()).toBe("The second table is easier");
});

test("who goes back stays there until Next", () => {
  const stop = followTour();
  useDesk.setState({ stage: "demonstrate" });
  turnTour(1);
  turnTour(-1);
  expect(title()).toBe("Four stages");
  useDesk.setState({ hover: "x" });
  expect(title()).toBe("Four stages");
  turnTour(1);
  expect(title()).toBe("Pick the splinters");
  stop();
});
