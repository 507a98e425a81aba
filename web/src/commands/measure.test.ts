// Keys of the section plane and of measuring.
import { beforeEach, expect, it } from "vitest";
import { initialRuler, useRuler } from "../store/ruler";
import { useScenes } from "../store/scenes";
import { initialSection, useSection } from "../store/section";
import { initialWorkspace, select, useWorkspace } from "../store/workspace";
import { box, boxScene } from "../viewport/stage/boxes.test-help";
import { commandFor, listCommands } from "./list";
import { measureCommands } from "./measure";

const scene = boxScene([box("a", [0, 0, 0]), box("b", [1.5, 0, 0]), box("c", [0.5, 0, 0])]);
const press = (key: string) => commandFor(key)?.run();
const latest = () => useRuler.getState().measures.at(-1);

beforeEach(() => {
  useWorkspace.setState({ ...initialWorkspace, asset: "a", stage: "demonstrate" }, true);
  useScenes.setState({ scene });
  useRuler.setState(initialRuler, true);
  useSection.setState(initialSection, true);
});

it.each(measureCommands.flatMap(({ id, keys }) => keys.map((key) => [key, id] as const)))("%s is no key of another command: %s", (key, id) => {
  expect(listCommands().filter((command) => command.keys.includes(key)).map((command) => command.id)).toEqual([id]);
});

it("Shift+K opens the section and closes it", () => {
  press("Shift+K");
  expect(useSection.getState().on).toBe(true);
  press("Shift+K");
  expect(useSection.getState().on).toBe(false);
});

it("D takes the ruler and puts it down, as Escape does", () => {
  press("D");
  expect(useWorkspace.getState().tool).toBe("ruler");
  press("D");
  expect(useWorkspace.getState().tool).toBe("select");
});

it("Shift+D measures the gap between two selected hulls, and the extents of one or of more", () => {
  select(["a", "b"]);
  press("Shift+D");
  expect(latest()).toMatchObject({ what: "Gap between a and b", along: [expect.closeTo(0.5), expect.closeTo(0), expect.closeTo(0)] });
  expect(latest()?.length).toBeCloseTo(0.5, 6);
  select(["a", "c"]);
  press("Shift+D");
  expect(latest()).toMatchObject({ length: 0 });
  select(["b"]);
  press("Shift+D");
  expect(latest()).toMatchObject({ what: "Extents of b", along: [1, 1, 1] });
  select(["a", "b", "c"]);
  press("Shift+D");
  expect(latest()).toMatchObject({ what: "Extents of 3 hulls", along: [2.5, 1, 1] });
});

it("nothing is measured where nothing is selected", () => {
  expect(commandFor("Shift+D")).toBeUndefined();
});
