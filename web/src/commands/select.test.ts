// Keys that select and hide hulls.
import { beforeEach, describe, expect, it } from "vitest";
import { useScenes } from "../store/scenes";
import { initialWorkspace, select, useWorkspace } from "../store/workspace";
import { commandFor } from "./list";
import { selectCommands } from "./select";

const hull = (name: string, label: string | null) => ({ name, label });
// a row of touching hulls, and one apart: a - b - c - d, e
const hulls = [hull("a", "leg"), hull("b", null), hull("c", "top"), hull("d", "leg"), hull("e", null)];
const contacts = [
  ["a", "b"],
  ["b", "c"],
  ["c", "d"],
];
const press = (key: string) => commandFor(key, selectCommands)?.run();
const selected = () => [...useWorkspace.getState().selection].sort();
const hidden = () => [...useWorkspace.getState().hidden].sort();

beforeEach(() => {
  useWorkspace.setState({ ...initialWorkspace, asset: "t" }, true);
  useScenes.setState({ scene: { asset: "t", hulls, contacts } as never });
});

describe("keys that select", () => {
  it("select all, none, or all others", () => {
    press("A");
    expect(selected()).toEqual(["a", "b", "c", "d", "e"]);
    press("Alt+A");
    expect(selected()).toEqual([]);
    select(["a", "c"]);
    press("I");
    expect(selected()).toEqual(["b", "d", "e"]);
  });

  it("grow the selection by one contact at a time", () => {
    select(["a"]);
    press("G");
    expect(selected()).toEqual(["a", "b"]);
    press("G");
    expect(selected()).toEqual(["a", "b", "c"]);
  });

  it("take all that is connected, and leave what is apart", () => {
    select(["d"]);
    press("Shift+G");
    expect(selected()).toEqual(["a", "b", "c", "d"]);
  });

  it("take all with the same label, no label being one, too", () => {
    select(["a"]);
    press("Shift+L");
    expect(selected()).toEqual(["a", "d"]);
    select(["b"]);
    press("Shift+L");
    expect(selected()).toEqual(["b", "e"]);
  });

  it("never take what is hidden", () => {
    useWorkspace.setState({ hidden: new Set(["b", "d"]) });
    press("A");
    expect(selected()).toEqual(["a", "c", "e"]);
    select(["a"]);
    press("G");
    expect(selected()).toEqual(["a"]);
  });

  it("mean nothing without a selection where they need one", () => {
    for (const key of ["G", "Shift+G", "Shift+L", "H", "Shift+H"]) expect(commandFor(key, selectCommands)).toBeUndefined();
    select(["a"]);
    for (const key of ["G", "Shift+G", "Shift+L", "H", "Shift+H"]) expect(commandFor(key, selectCommands)).toBeDefined();
  });

  it("mean nothing while another asset is still shown", () => {
    select(["a"]);
    useWorkspace.setState({ asset: "other" });
    expect(commandFor("A", selectCommands)).toBeUndefined();
    expect(commandFor("G", selectCommands)).toBeUndefined();
  });

  it("mean nothing on an asset without hulls", () => {
    useScenes.setState({ scene: { asset: "t", hulls: [], contacts: [] } as never });
    expect(commandFor("A", selectCommands)).toBeUndefined();
  });
});

describe("keys that hide", () => {
  it("put the selection out of sight, and out of the selection", () => {
    select(["a", "b"]);
    press("H");
    expect([hidden(), selected()]).toEqual([["a", "b"], []]);
    select(["c"]);
    press("H");
    expect(hidden()).toEqual(["a", "b", "c"]);
  });

  it("leave the selection alone in sight", () => {
    select(["a", "b"]);
    press("Shift+H");
    expect([hidden(), selected()]).toEqual([["c", "d", "e"], ["a", "b"]]);
  });

  it("show all again where the selection is alone in sight already, and the selection stays", () => {
    select(["a", "b"]);
    press("Shift+H");
    press("Shift+H");
    expect([hidden(), selected()]).toEqual([[], ["a", "b"]]);
  });

  it("bring all back, if anything is hidden", () => {
    expect(commandFor("Alt+H", selectCommands)).toBeUndefined();
    select(["a"]);
    press("H");
    press("Alt+H");
    expect(hidden()).toEqual([]);
  });
});
