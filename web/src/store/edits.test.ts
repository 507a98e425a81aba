// Edits, one after the other, and what is said of them.
import { beforeEach, expect, test, vi } from "vitest";
import { api } from "../server/api";
import { page, ServerProblem } from "../server/http";
import { jumpTo, pendingEdits, perform, capitalize, undo, useUnsaved } from "./edits";
import { emptyProject, receive, useProject } from "./project";
import { useToasts } from "./toasts";

vi.mock("../server/api", () => ({ api: { edit: vi.fn(), undo: vi.fn(), redo: vi.fn() } }));

const edit = vi.mocked(api.edit);
const toasts = () => useToasts.getState().toasts;
const labels = { kind: "vocabulary" as const, labels: [] };

beforeEach(() => {
  vi.clearAllMocks();
  useToasts.setState({ toasts: [] });
  useProject.setState(emptyProject, true);
});

test("what was done is notified, and can be undone", async () => {
  edit.mockResolvedValue({ message: "labelled 3 hulls" });
  expect(await perform(labels)).toBe(true);
  expect(toasts()[0]).toMatchObject({ text: "Labelled 3 hulls", undo: true });
});

test("what changed nothing offers no undo; what is quiet is not notified", async () => {
  edit.mockResolvedValue({ message: "nothing to label", nothing: true });
  await perform(labels);
  expect(toasts()[0]?.undo).toBe(false);
  await perform(labels, { quiet: true });
  expect(toasts()).toHaveLength(1);
});

test("undoing says that it was undone, and offers no undo of that", async () => {
  vi.mocked(api.undo).mockResolvedValue({ message: "step 1 of a: Delete" });
  await undo();
  expect(toasts()[0]).toMatchObject({ text: "Undone: step 1 of a: Delete", undo: false });
});

test("jumping undoes or redoes up to a state, by one request", async () => {
  useProject.setState({ history: { undo: "a", redo: "b", undoable: 5, redoable: 4 } });
  vi.mocked(api.undo).mockResolvedValue({ message: "x" });
  vi.mocked(api.redo).mockResolvedValue({ message: "x" });
  await Promise.all([jumpTo(2, "Undone: 3 acts"), jumpTo(9, "Redone: 4 acts")]);
  expect([vi.mocked(api.undo).mock.calls, vi.mocked(api.redo).mock.calls]).toEqual([[[2]], [[9]]]);
  expect(toasts().map(({ text }) => text)).toEqual(["Undone: 3 acts", "Redone: 4 acts"]);
});

test("an edit waits for those before it, also where one is refused", async () => {
  const order: string[] = [];
  edit.mockImplementationOnce(async () => {
    await new Promise((soon) => setTimeout(soon, 5));
    order.push("first");
    throw new ServerProblem({ message: "changed since", where: null, remedy: null, conflict: true }, 409);
  });
  edit.mockImplementationOnce(() => Promise.resolve({ message: (order.push("second"), "done") }));
  expect(await Promise.all([perform(labels), perform(labels)])).toEqual([false, true]);
  expect(order).toEqual(["first", "second"]);
  expect(toasts().map((toast) => toast.kind)).toEqual(["problem", "done"]);
});

test.each([
  ["before it was made: it is sent again", 0, 2],
  ["after it was made: it is not made twice", 1, 1],
])("an edit waits for a server that stops %s", async (_, undoable, sent) => {
  useProject.setState({ ready: true, connected: true });
  edit.mockRejectedValueOnce(new ServerProblem({ message: "gone", where: null, remedy: null, conflict: false }, 0));
  edit.mockResolvedValue({ message: "done", nothing: true });
  const done = perform(labels);
  await vi.waitFor(() => expect(edit).toHaveBeenCalledOnce());
  useProject.setState({ connected: false });
  const other = perform(labels, { quiet: true });
  expect(useUnsaved.getState().count).toBe(2);
  useProject.setState({ connected: true, hellos: 1, history: { ...emptyProject.history, undoable, undo: "done" } });
  expect(await Promise.all([done, other])).toEqual([true, true]);
  expect(edit).toHaveBeenCalledTimes(sent + 1);
  expect(toasts().map(({ text }) => text)).toEqual(["done"]);
  expect(useUnsaved.getState().count).toBe(0);
});

test("an edit is over when the page knows what it changed, or is not connected any more", async () => {
  useProject.setState({ connected: true });
  edit.mockResolvedValue({ message: "done" });
  const over = vi.fn();
  void perform(labels).then(over);
  const history = { kind: "history", history: emptyProject.history, did: "edit", message: "done" } as const;
  receive({ ...history, by: "another page" });
  await new Promise((soon) => setTimeout(soon, 20));
  expect([over.mock.calls.length, pendingEdits() === null]).toEqual([0, false]);
  receive({ ...history, by: page });
  await expect.poll(() => [over.mock.calls.length, pendingEdits()]).toEqual([1, null]);
  void perform(labels).then(over);
  await new Promise((soon) => setTimeout(soon, 20));
  expect(over).toHaveBeenCalledTimes(1);
  useProject.setState({ connected: false });
  await expect.poll(() => over.mock.calls.length).toBe(2);
});

test("names of files keep their first letter", () => {
  expect(["table_1.obj: fine", "vocabulary: a, b", "step 1", "a/b: fine"].map(capitalize)).toEqual([
    "table_1.obj: fine",
    "Vocabulary: a, b",
    "Step 1",
    "a/b: fine",
  ]);
});
