// Messages at the foot of the window.
import { beforeEach, expect, test } from "vitest";
import { dismissToast, notify, useToasts } from "./toasts";

beforeEach(() => useToasts.setState({ toasts: [] }));

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
