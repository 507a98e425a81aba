// Messages at the foot of the window.
import { beforeEach, expect, test } from "vitest";
import { dismissed, told, useToasts } from "./toasts";

beforeEach(() => useToasts.setState({ toasts: [] }));

test("only the latest message offers undo, since undo takes back the latest edit", () => {
  told("Labelled 3 hulls.", true);
  told("Deleted 2 hulls.", true);
  told("Copied.");
  expect(useToasts.getState().toasts.map((toast) => toast.undo)).toEqual([false, true, false]);
});

test("few messages are kept, the latest", () => {
  for (const text of ["1", "2", "3", "4", "5"]) told(text);
  expect(useToasts.getState().toasts.map((toast) => toast.text)).toEqual(["2", "3", "4", "5"]);
});

test("a message goes when it is dismissed", () => {
  told("Saved.");
  dismissed(useToasts.getState().toasts[0]?.id ?? -1);
  expect(useToasts.getState().toasts).toEqual([]);
});
