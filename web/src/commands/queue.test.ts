
import { afterEach, expect, test, vi } from "vitest";
import { api } from "../server/api";
import { perform } from "../store/edits";
import { useToasts } from "../store/toasts";
import { isBusy, runInTurn, runKey } from "./queue";

vi.mock("../server/api", () => ({ api: { edit: vi.fn() } }));

function slow() {
  let end = (): void => undefined;
  const done = new Promise<void>((resolve) => (end = resolve));
  return { done, end };
}

afterEach(() => {
  vi.useRealTimers();
});

test("what is quick is run at once", () => {
  const ran: string[] = [];
  runInTurn(() => ran.push("quick"));
  runInTurn(() => undefined);
  expect([ran, isBusy()]).toEqual([["quick"], false]);
});

test("what is typed ahead waits, and means what it means then", async () => {
  const [ran, first, second] = [[] as string[], slow(), slow()];
  let hand = "empty";
  runInTurn(() => first.done.then(() => (hand = "full")));
  runInTurn(() => {
    ran.push(hand);
    return second.done;
  });
  runInTurn(() => ran.push("third"));
  expect([ran, isBusy()]).toEqual([[], true]);
  first.end();
  await first.done;
  await expect.poll(() => ran).toEqual(["full"]);
  second.end();
  await expect.poll(() => [ran, isBusy()]).toEqual([["full", "third"], false]);
});

test("what never ends does not hold up the keys for ever", async () => {
  vi.useFakeTimers();
  const ran: string[] = [];
  runInTurn(() => new Promise(() => undefined));
  runInTurn(() => ran.push("after"));
  await vi.advanceTimersByTimeAsync(9000);
  expect(ran).toEqual([]);
  await vi.advanceTimersByTimeAsync(2000);
  expect([ran, isBusy()]).toEqual([["after"], false]);
});

test("what fails is reported, and does not keep what comes after it from its turn", async () => {
  const ran: string[] = [];
  runInTurn(() => Promise.reject(new Error("no")));
  runInTurn(() => ran.push("after"));
  await expect.poll(() => ran).toEqual(["after"]);
  expect(useToasts.getState().toasts.map((toast) => toast.text)).toContain("no");
});

test("a key that means something only after an edit on its way waits for it; one that does already does not", async () => {
  const [ran, edit] = [[] as string[], slow()];
  let isKnown = false;
  vi.mocked(api.edit).mockImplementation(async () => {
    await edit.done;
    isKnown = true;
    return { message: "labels taken over" };
  });
  const made = perform({ kind: "unprepare", asset: "a" });
  runKey(() => () => ran.push("known before"));
  runKey(() => (isKnown ? () => ran.push("known after") : undefined));
  expect([ran, isBusy()]).toEqual([["known before"], true]);
  edit.end();
  await made;
  await expect.poll(() => [ran, isBusy()]).toEqual([["known before", "known after"], false]);
});
