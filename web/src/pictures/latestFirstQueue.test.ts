// Only a few pieces of work at once, the newest first.
import { expect, test } from "vitest";
import { LatestFirstQueue } from "./latestFirstQueue";

/** Work that ends when it is told to, and a list of what began. */
function works() {
  const begun: string[] = [];
  const ends = new Map<string, (value: string) => void>();
  const work = (name: string) => () => {
    begun.push(name);
    return new Promise<string>((good) => ends.set(name, good));
  };
  const end = async (name: string) => {
    ends.get(name)?.(name.toUpperCase());
    await new Promise((soon) => setTimeout(soon));
  };
  return { begun, work, end };
}

test("no more than so many go on at once; then the newest comes first", async () => {
  const { begun, work, end } = works();
  const line = new LatestFirstQueue<string>(2);
  for (const name of ["a", "b", "c", "d"]) line.ask(name, work(name));
  expect(begun).toEqual(["a", "b"]);
  await end("a");
  expect(begun).toEqual(["a", "b", "d"]);
  await end("b");
  expect(begun).toEqual(["a", "b", "d", "c"]);
});

test("all who ask for the same get the same", async () => {
  const { begun, work, end } = works();
  const line = new LatestFirstQueue<string>(1);
  const both = [line.ask("a", work("a")), line.ask("a", work("a"))];
  await end("a");
  expect(await Promise.all(both.map((one) => one.result))).toEqual(["A", "A"]);
  expect(begun).toEqual(["a"]);
});

test("what nobody wants any more never begins", async () => {
  const { begun, work, end } = works();
  const line = new LatestFirstQueue<string>(1);
  line.ask("a", work("a"));
  const first = line.ask("b", work("b"));
  const second = line.ask("b", work("b"));
  const gone = line.ask("c", work("c"));
  gone.drop();
  first.drop();
  first.drop();
  await end("a");
  expect(begun).toEqual(["a", "b"]);
  second.drop();
});

test("one that fails makes room for the next", async () => {
  const { begun, work } = works();
  const line = new LatestFirstQueue<string>(1);
  const bad = line.ask("a", () => Promise.reject(new Error("no")));
  line.ask("b", work("b"));
  await expect(bad.result).rejects.toThrow("no");
  await new Promise((soon) => setTimeout(soon));
  expect(begun).toEqual(["b"]);
});
