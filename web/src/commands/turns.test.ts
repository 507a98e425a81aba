import { expect, test } from "vitest";
import { inTurn, isBusy } from "./turns";

function slow() {
  let end = (): void => undefined;
  const done = new Promise<void>((resolve) => (end = resolve));
  return { done, end };
}

test("what is quick is run at once", () => {
  const ran: string[] = [];
  inTurn(() => ran.push("quick"));
  inTurn(() => undefined);
  expect([ran, isBusy()]).toEqual([["quick"], false]);
});

test("what is typed ahead waits, and means what it means then", async () => {
  const [ran, first, second] = [[] as string[], slow(), slow()];
  let hand = "empty";
  inTurn(() => first.done.then(() => (hand = "full")));
  inTurn(() => {
    ran.push(hand);
    return second.done;
  });
  inTurn(() => ran.push("third"));
  expect([ran, isBusy()]).toEqual([[], true]);
  first.end();
  await first.done;
  await expect.poll(() => ran).toEqual(["full"]);
  second.end();
  await expect.poll(() => [ran, isBusy()]).toEqual([["full", "third"], false]);
});
