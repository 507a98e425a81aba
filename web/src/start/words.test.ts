// What the start page says of assets and of projects.
import { expect, test } from "vitest";
import { brokenText, decomposeText, foundText, moveInto, openedText, partsText } from "./words";
import { describeFolder, joinPath } from "./FolderDialog";

const found = { folder: "/a", kinds: "12 URDF", assets: 12, read: 12, pieces: 0, seen: 0, bare: 0, divided: 0, parts: [], broken: 0, problem: null, left_out: false, project: "/p" };

test("what is found says where not all was looked at", () => {
  expect(foundText(found)).toBe("12 URDF");
  expect(foundText({ ...found, read: 5 })).toBe("12 URDF; the first 5 were looked at");
});

test("making hulls is explained where hulls are missing only", () => {
  expect(decomposeText(found)).toBe(null);
  expect(decomposeText({ ...found, bare: 1, pieces: 1 })).toContain("1 of 12 has geometry that is not convex, or no collision geometry: 1 piece.");
  expect(decomposeText({ ...found, bare: 1, pieces: 3, seen: 2 })).toContain("3 pieces. 2 of these are only seen now, and would collide.");
  expect(decomposeText({ ...found, read: 5, bare: 3, pieces: 4 })).toContain("3 of the first 5 have");
});

test("known parts are named, and what becomes of them", () => {
  expect(partsText(found, "parts")).toBe(null);
  const cup = { ...found, divided: 1, parts: ["wall", "handle"] };
  expect(partsText(cup, "whole")).toBe("1 asset says what its parts are (wall and handle): a hull may hold several of them.");
  expect(partsText({ ...cup, divided: 2 }, "parts")).toBe("2 assets say what their parts are (wall and handle): no hull crosses from one to another, and hulls are called by them.");
});

test("what cannot be read says why", () => {
  expect(brokenText(found)).toBe(null);
  expect(brokenText({ ...found, broken: 2, problem: "a.urdf: no mesh" })).toBe("2 assets cannot be read. a.urdf: no mesh. The project can be made all the same.");
  const sent = { ...found, left_out: true, problem: "a.urdf: no mesh." };
  expect(brokenText({ ...sent, broken: 1 })).toBe("1 asset cannot be read and is left out. a.urdf: no mesh.");
  expect(brokenText({ ...sent, broken: 2 })).toContain("2 assets cannot be read and are left out.");
});

test("days are told as people say them", () => {
  const now = new Date(2026, 10, 26, 9).getTime();
  const at = (day: number, hour: number) => new Date(2026, 10, day, hour).toISOString();
  expect([openedText(at(26, 1), now), openedText(at(25, 23), now), openedText(at(20, 9), now), openedText("", now)]).toEqual(["today", "yesterday", "November 20, 2026", ""]);
});

test("a project keeps its name when it goes into another folder", () => {
  expect([moveInto("/a/b", "/x/cups"), moveInto("/", "/x/cups/"), moveInto("/a", "")]).toEqual(["/a/b/cups", "/cups", "/a/project"]);
});

test("folders are joined and described", () => {
  expect([joinPath("/", "a"), joinPath("/a", "b")]).toEqual(["/a", "/a/b"]);
  const view = { folder: "/a", parent: "/", project: false, entries: [], more: 0, files: 2 };
  expect([describeFolder(view), describeFolder({ ...view, project: true })]).toEqual(["2 asset or mesh files in this folder itself", "This folder is a project."]);
});
