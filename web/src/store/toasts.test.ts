// Messages at the foot of the window.
import { beforeEach, expect, test, vi } from "vitest";
import { postJson, ServerProblem, setToken } from "../server/http";
import { dismissToast, notify, reportError, reportProblem, useToasts } from "./toasts";

beforeEach(() => useToasts.setState({ toasts: [], problems: [] }));

test("only the latest message offers undo, since undo takes back the latest edit", () => {
  notify("Labelled 3 hulls.", true);
  notify("Deleted 2 hulls.", true);
  notify("Copied.");
  expect(useToasts.getState().toasts.map((toast) => toast.undo)).toEqual([false, true, false]);
});

test("few messages are kept, the latest", () => {
  for (const text of ["1", "2", "3", "4", "5"]) notify(text);
  expect(useToasts.getState().toasts.map((toast) => toast.text)).toEqual(["2", "3", "4", "5"]);
});

test("a message goes when it is dismissed", () => {
  notify("Saved.");
  dismissToast(useToasts.getState().toasts[0]?.id ?? -1);
  expect(useToasts.getState().toasts).toEqual([]);
});

test("a problem says where it is, and how to fix it", () => {
  reportProblem({ message: "no mesh", where: "a.urdf", remedy: "Add the file.", conflict: false });
  reportProblem({ message: "the disk is full", where: null, remedy: null, conflict: false });
  expect(useToasts.getState().toasts.map(({ kind, text, remedy }) => [kind, text, remedy])).toEqual([
    ["problem", "a.urdf: no mesh", "Add the file."],
    ["problem", "the disk is full", null],
  ]);
});

test("an error of the server is reported as it is, any other as a bug", () => {
  reportError(new ServerProblem({ message: "changed elsewhere", where: null, remedy: "Reload.", conflict: true }, 409));
  reportError(new TypeError("x is undefined"));
  reportError("odd");
  const [server, bug, odd] = useToasts.getState().toasts;
  expect([server?.text, server?.remedy]).toEqual(["changed elsewhere", "Reload."]);
  expect([bug?.text, odd?.text]).toEqual(["x is undefined", "odd"]);
  expect(bug?.remedy).toContain("bug in the studio");
});

test("what the page stopped itself is no error", () => {
  reportError(new DOMException("stopped", "AbortError"));
  expect(useToasts.getState().toasts).toEqual([]);
});

test("each message has a number of its own, so that one is dismissed alone", () => {
  notify("one");
  notify("one");
  const [first] = useToasts.getState().toasts;
  dismissToast(first?.id ?? -1);
  expect(useToasts.getState().toasts.map(({ text }) => text)).toEqual(["one"]);
});

test("a problem goes when the same act succeeds, or the server is back, and is kept in the list", async () => {
  setToken("t");
  const answer = (status: number) => vi.stubGlobal("fetch", async () => new Response(status === 200 ? "{}" : JSON.stringify(problem(status)), { status }));
  const problem = (status: number) => ({ message: `problem ${status}`, where: null, remedy: null, conflict: false });
  const edit = (kind: string, asset: string) => postJson("api/edit", { kind, asset }).catch(reportError);
  const texts = () => useToasts.getState().toasts.map(({ text }) => text);
  answer(400);
  await edit("cut", "a");
  await edit("cut", "a");
  expect(texts()).toEqual(["problem 400"]);
  answer(200);
  await edit("cut", "b");
  await edit("steps", "a");
  expect(texts()).toEqual(["problem 400"]);
  await edit("cut", "a");
  expect(texts()).toEqual([]);
  vi.stubGlobal("fetch", () => Promise.reject(new TypeError("no network")));
  await edit("cut", "a");
  expect(texts()).toEqual(["The studio's server does not answer."]);
  answer(200);
  await edit("steps", "b");
  expect(texts()).toEqual([]);
  expect(useToasts.getState().problems.map(({ text }) => text)).toEqual(["The studio's server does not answer.", "problem 400"]);
  vi.unstubAllGlobals();
});
